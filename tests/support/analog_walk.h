#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "brute_force.h"

namespace airlight::test {

/// Light scattered again and again, as a plain walk of photons run backwards: one colour at a time,
/// every event where it happens to fall. Boxes of fog, by default one from -1 to 1, perhaps a floor
/// and a ball, one parallel light. Flights go on from one possible event to the next of the densest
/// fog, and most often nothing happens there: they know of no boundary. Nothing of the library's
/// maths.
struct AnalogWalk {
  static constexpr int orders = 8;

  /// A box of fog; no two of them overlap.
  struct Fog {
    double sigma_t = 1, albedo = 1, g = 0;
    Vector min{-1, -1, -1}, max{1, 1, 1};
  };

  std::vector<Fog> fogs{Fog()};
  Vector sun;  ///< towards the light
  double irradiance = 1;
  std::optional<double> floor_albedo, ball_albedo;
  static constexpr double floor_height = -0.8, floor_half = 3;
  static constexpr double ball_radius = 0.5;

  /// Radiance by order, of one walk from a camera ray.
  template <class Generator>
  std::array<double, orders> operator()(CameraRay ray, Generator& random) const {
    std::uniform_real_distribution<double> u;
    std::array<double, orders> light{};
    double weight = 1;
    for (double& order : light) {
      const Hit hit = nearest(ray);
      const auto [fog, flight] = fly(ray, hit.t, random);
      if (fog) {
        const Vector p = ray.origin + ray.direction * flight;
        weight *= fog->albedo;
        order = weight * irradiance * phase(*fog, dot(ray.direction, sun)) * arriving(p);
        ray = {p, turn(ray.direction, scattering_cosine(*fog, u(random)), u(random))};
      } else if (hit.t < far) {
        const Vector p = ray.origin + ray.direction * hit.t + hit.normal * 1e-9;
        weight *= hit.albedo;
        order = weight * irradiance / pi * std::max(dot(hit.normal, sun), 0.) * arriving(p);
        ray = {p, turn(hit.normal, std::sqrt(u(random)), u(random))};
      } else {
        break;
      }
    }
    return light;
  }

 private:
  static constexpr double far = 1e30;
  static constexpr double pi = 3.14159265358979323846;

  struct Hit {
    double t = far;
    Vector normal;
    double albedo = 0;
  };

  /// Where a ray scatters before t_end, and in what; null: nowhere.
  template <class Generator>
  std::pair<const Fog*, double> fly(const CameraRay& ray, double t_end, Generator& random) const {
    std::uniform_real_distribution<double> u;
    double densest = 0, t = far, last = 0;
    for (const Fog& fog : fogs) {
      densest = std::max(densest, fog.sigma_t);
      const auto [enter, exit] = inside(fog, ray);
      if (enter < exit) t = std::min(t, enter), last = std::max(last, exit);
    }
    t_end = std::min(t_end, last);
    while ((t -= std::log1p(-u(random)) / densest) < t_end) {
      const Vector p = ray.origin + ray.direction * t;
      for (const Fog& fog : fogs)
        if (fog.min.x <= p.x && p.x <= fog.max.x && fog.min.y <= p.y && p.y <= fog.max.y &&
            fog.min.z <= p.z && p.z <= fog.max.z) {
          if (u(random) * densest < fog.sigma_t) return {&fog, t};
          break;
        }
    }
    return {nullptr, 0};
  }

  static std::pair<double, double> inside(const Fog& fog, const CameraRay& ray) {
    double enter = 0, exit = far;
    for (int k = 0; k < 3; ++k) {
      const double o = ray.origin[k], d = ray.direction[k];
      const double a = (fog.min[k] - o) / d, b = (fog.max[k] - o) / d;
      enter = std::max(enter, std::min(a, b)), exit = std::min(exit, std::max(a, b));
    }
    return {enter, std::max(enter, exit)};
  }

  Hit nearest(const CameraRay& ray) const {
    Hit hit;
    if (floor_albedo) {
      const double t = (floor_height - ray.origin.y) / ray.direction.y;
      const Vector p = ray.origin + ray.direction * t;
      if (t > 0 && std::abs(p.x) < floor_half && std::abs(p.z) < floor_half)
        hit = {t, Vector(0, ray.direction.y < 0 ? 1 : -1, 0), *floor_albedo};
    }
    if (ball_albedo) {
      const double b = dot(ray.origin, ray.direction);
      const double under = b * b - dot(ray.origin, ray.origin) + ball_radius * ball_radius;
      if (under > 0) {
        const double t = -b - std::sqrt(under);
        if (t > 0 && t < hit.t) hit = {t, normalize(ray.origin + ray.direction * t), *ball_albedo};
      }
    }
    return hit;
  }

  double arriving(const Vector& p) const {
    const CameraRay to_sun{p, sun};
    if (nearest(to_sun).t < far) return 0;
    double depth = 0;
    for (const Fog& fog : fogs) {
      const auto [enter, exit] = inside(fog, to_sun);
      depth += fog.sigma_t * (exit - enter);
    }
    return std::exp(-depth);
  }

  static double phase(const Fog& fog, double cosine) {
    const double g = fog.g;
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  }
  static double scattering_cosine(const Fog& fog, double u) {
    const double g = fog.g;
    if (g == 0) return 1 - 2 * u;
    const double s = (1 - g * g) / (1 - g + 2 * g * u);
    return (1 + g * g - s * s) / (2 * g);
  }

  static Vector turn(const Vector& axis, double cosine, double u) {
    const Vector other = std::abs(axis.x) < 0.5 ? Vector(1, 0, 0) : Vector(0, 1, 0);
    const Vector a = normalize(cross(axis, other)), b = cross(axis, a);
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.));
    return axis * cosine + a * (sine * std::cos(2 * pi * u)) + b * (sine * std::sin(2 * pi * u));
  }
};

}  // namespace airlight::test
