#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "quadrature.h"
#include "scene/scene.h"

namespace airlight::test {

using Vector = Vec3<double>;
using Colour = Rgb<double>;

inline Colour exp_of(const Colour& sigma, double length) {
  return {std::exp(-sigma.r * length), std::exp(-sigma.g * length), std::exp(-sigma.b * length)};
}

/// The camera ray through a point of the picture, in pixels from its upper left corner.
struct CameraRay {
  Vector origin, direction;
};

inline CameraRay camera_ray(const Scene& scene, double x, double y) {
  const Camera& camera = scene.camera;
  const Vector forward = normalize(camera.target - camera.position);
  const Vector right = normalize(cross(forward, camera.up)), up = cross(right, forward);
  const double slope = std::tan(camera.fov * std::acos(-1.) / 360);
  const double aspect = double(scene.resolution.width) / scene.resolution.height;
  const double X = (x / scene.resolution.width * 2 - 1) * slope * aspect;
  const double Y = (1 - y / scene.resolution.height * 2) * slope;
  return {camera.position, normalize(forward + right * X + up * Y)};
}

/// A rectangle, corner + s right + t up with s and t in [0, 1], that reflects and filters light.
struct Sheet {
  Vector corner, right, up;
  Colour albedo{0., 0., 0.};
  Colour tint{1., 1., 1.};
  std::function<double(double s, double t)> opacity = [](double, double) { return 1.; };
  std::vector<double> breaks = {};  ///< values of s, and of t, at which the opacity jumps or bends

  Vector normal() const { return normalize(cross(right, up)); }

  /// The same as an object of a scene. The material says what `opacity` says.
  Object object(const char* name, Material material = {}) const {
    Mesh mesh;
    for (const Vector& p : {corner, corner + right, corner + right + up, corner + up})
      mesh.positions.push_back(Vec3<float>(p));
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    material.albedo = albedo;
    material.tint = tint;
    return {name, mesh, material};
  }
};

/// Single scattering among sheets in a box of fog with its faces along the axes, pixel by pixel:
/// what the renderer estimates, written down once more as integrals and given to quadrature. Takes
/// numbers from the scene and nothing from the library's maths.
class BruteForce {
 public:
  BruteForce(const Scene& scene, std::vector<Sheet> sheets)
      : scene_(scene), sheets_(std::move(sheets)) {}

  /// Radiance from surfaces and background along a ray. Lights are parallel.
  Colour surface(const CameraRay& ray) const {
    Colour sum, filter(1.);
    for (const auto& [t, sheet] : crossings(ray)) {
      const Vector p = ray.origin + ray.direction * t;
      const auto [s, u] = place(*sheet, p);
      const double opacity = sheet->opacity(s, u);
      const Colour seen = filter * dimmed(ray, t);
      Colour light = scene_.ambient * pi;
      for (const Lights& any : scene_.lights) {
        const auto& sun = std::get<Directional>(any);
        light += sun.irradiance * irradiance(*sheet, p, ray.direction, -sun.direction);
      }
      sum += seen * sheet->albedo * opacity * light * (1 / pi);
      filter = filter * sheet->tint * (1 - opacity);
    }
    return sum + filter * dimmed(ray, infinity) * scene_.background;
  }

  /// What part of a light's irradiance at normal incidence a sheet receives at p on the side that
  /// the viewer looks at: cosine, shadows, fog.
  Colour irradiance(const Sheet& sheet, const Vector& p, const Vector& view,
                    const Vector& toward) const {
    Vector n = sheet.normal();
    if (dot(n, view) > 0) n = -n;
    const double cosine = dot(n, toward);
    if (cosine <= 0) return {};
    Colour result = passed(p, toward, infinity, &sheet) * cosine;
    if (!scene_.media.empty()) {
      const auto [enter, leave] = clip({p, toward});
      if (leave > enter) result = result * exp_of(scene_.media[0].sigma_t, leave - enter);
    }
    return result;
  }

  /// What reaches the camera from the background.
  Colour transmittance(const CameraRay& ray) const {
    Colour filter(1.);
    for (const auto& [t, sheet] : crossings(ray)) {
      const auto [s, u] = place(*sheet, ray.origin + ray.direction * t);
      filter = filter * sheet->tint * (1 - sheet->opacity(s, u));
    }
    return filter * dimmed(ray, infinity);
  }

  /// Light emitted by the fog, by quadrature.
  Colour emission(const CameraRay& ray) const {
    return along(ray, {}, [&](double, double depth_so_far, const Vector&) {
      return scene_.media[0].emission * exp_of(scene_.media[0].sigma_t, depth_so_far);
    });
  }

  /// Light scattered once by the fog from parallel light that comes from `toward`.
  Colour in_scatter(const CameraRay& ray, const Directional& sun, const Vector& toward,
                    bool with_shadows = true, int channels = 3) const {
    const Medium& medium = scene_.media[0];
    std::vector<double> breaks;
    for (const Sheet& sheet : sheets_) add_shadow_edges(sheet, ray, toward, breaks);
    const double phase = phase_function(dot(toward, ray.direction));
    return along(
        ray, breaks,
        [&](double, double depth_so_far, const Vector& p) {
          const Colour light = with_shadows ? passed(p, toward, infinity, nullptr) : Colour(1.);
          const double way = depth_so_far + std::max(clip({p, toward}).second, 0.);
          return medium.sigma_s * sun.irradiance * light * exp_of(medium.sigma_t, way) * phase;
        },
        with_shadows, channels);
  }

  /// One channel of the same, for grey media: three times as fast.
  double in_scatter_grey(const CameraRay& ray, const Directional& sun, const Vector& toward,
                         bool with_shadows) const {
    return in_scatter(ray, sun, toward, with_shadows, 1).r;
  }

  /// The same of every light.
  Colour in_scatter(const CameraRay& ray) const {
    Colour sum;
    if (scene_.media.empty()) return sum;
    for (const Lights& any : scene_.lights) {
      const auto& sun = std::get<Directional>(any);
      sum += in_scatter(ray, sun, -sun.direction);
    }
    return sum;
  }

  /// The first sheet a ray meets and where; nothing: null.
  std::pair<double, const Sheet*> first(const CameraRay& ray) const {
    const auto all = crossings(ray);
    return all.empty() ? std::pair<double, const Sheet*>(0, nullptr) : all.front();
  }

  /// Entry and exit of the fog, empty if not in order; the entry is not behind the origin.
  std::pair<double, double> clip(const CameraRay& ray) const {
    if (scene_.media.empty()) return {0, 0};
    const Box& box = std::get<Box>(scene_.media[0].shape);
    double enter = 0, leave = infinity;
    for (int k = 0; k < 3; ++k) {
      const double o = ray.origin[k], d = ray.direction[k];
      if (d == 0) {
        if (o < box.min[k] || o > box.max[k]) return {1, 0};
        continue;
      }
      const double a = (box.min[k] - o) / d, b = (box.max[k] - o) / d;
      enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return {enter, leave};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double pi = 3.14159265358979323846;

  double phase_function(double cosine) const {
    double g = 0;
    if (const auto* hg = std::get_if<HenyeyGreenstein>(&scene_.media[0].phase)) g = hg->g;
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  }

  /// (s, t) of a point in a sheet's plane.
  static std::pair<double, double> place(const Sheet& sheet, const Vector& p) {
    const Vector q = p - sheet.corner;
    return {dot(q, sheet.right) / dot(sheet.right, sheet.right),
            dot(q, sheet.up) / dot(sheet.up, sheet.up)};
  }

  /// Sheets along a ray, the nearest first; those that nothing is left of are not skipped.
  std::vector<std::pair<double, const Sheet*>> crossings(const CameraRay& ray) const {
    std::vector<std::pair<double, const Sheet*>> found;
    for (const Sheet& sheet : sheets_) {
      const Vector n = sheet.normal();
      const double t = dot(sheet.corner - ray.origin, n) / dot(ray.direction, n);
      if (!(t > 0)) continue;
      const auto [s, u] = place(sheet, ray.origin + ray.direction * t);
      if (s >= 0 && s <= 1 && u >= 0 && u <= 1) found.push_back({t, &sheet});
    }
    std::ranges::sort(found);
    return found;
  }

  /// The product of what the sheets let through between p and p + t_max w, but for one.
  Colour passed(const Vector& p, const Vector& w, double t_max, const Sheet* but) const {
    Colour product(1.);
    for (const Sheet& sheet : sheets_) {
      if (&sheet == but) continue;
      const Vector n = sheet.normal();
      const double t = dot(sheet.corner - p, n) / dot(w, n);
      if (!(t > 0 && t < t_max)) continue;
      const auto [s, u] = place(sheet, p + w * t);
      if (s >= 0 && s <= 1 && u >= 0 && u <= 1)
        product = product * sheet.tint * (1 - sheet.opacity(s, u));
    }
    return product;
  }

  Colour dimmed(const CameraRay& ray, double t) const {
    if (scene_.media.empty()) return Colour(1.);
    const auto [enter, leave] = clip(ray);
    return exp_of(scene_.media[0].sigma_t, std::max(std::min(t, leave) - enter, 0.));
  }

  /// Where the light that reaches points of the ray passes an edge of the sheet, or a place where
  /// its opacity jumps: seen along w, s and t of the sheet are linear in the distance.
  static void add_shadow_edges(const Sheet& sheet, const CameraRay& ray, const Vector& w,
                               std::vector<double>& breaks) {
    const Vector n = sheet.normal();
    if (dot(w, n) == 0) return;
    const auto landed = [&](double t) {
      const Vector p = ray.origin + ray.direction * t;
      return place(sheet, p + w * (dot(sheet.corner - p, n) / dot(w, n)));
    };
    const auto [s0, t0] = landed(0);
    const auto [s1, t1] = landed(1);
    std::vector<double> values = sheet.breaks;
    values.push_back(0), values.push_back(1);
    for (double value : values) {
      if (s1 != s0) breaks.push_back((value - s0) / (s1 - s0));
      if (t1 != t0) breaks.push_back((value - t0) / (t1 - t0));
    }
    breaks.push_back(dot(sheet.corner - ray.origin, n) / dot(ray.direction, n));
  }

  /// ∫ f(t, length in the fog up to t, point) × what the sheets in between let through, over the
  /// part of a camera ray in the fog, to 1e-9.
  template <class Function>
  Colour along(const CameraRay& ray, std::vector<double> breaks, Function&& f,
               bool with_sheets = true, int channels = 3) const {
    const auto [enter, leave] = clip(ray);
    if (!(leave > enter)) return {};
    if (with_sheets)
      for (const auto& [t, sheet] : crossings(ray)) breaks.push_back(t);
    Colour result;
    for (int c = 0; c < channels; ++c)
      result[c] = integrate(
          enter, end_of(ray, leave),
          [&, from = enter](double t) {
            const Vector p = ray.origin + ray.direction * t;
            const Colour seen =
                with_sheets ? passed(ray.origin, ray.direction, t, nullptr) : Colour(1.);
            return (f(t, t - from, p) * seen)[c];
          },
          1e-9, breaks);
    return result;
  }

  /// Where the first opaque sheet ends the ray, or the fog does.
  double end_of(const CameraRay& ray, double leave) const {
    for (const auto& [t, sheet] : crossings(ray)) {
      const auto [s, u] = place(*sheet, ray.origin + ray.direction * t);
      if (sheet->opacity(s, u) >= 1) return std::clamp(t, clip(ray).first, leave);
    }
    return leave;
  }

  const Scene& scene_;
  std::vector<Sheet> sheets_;
};

}  // namespace airlight::test
