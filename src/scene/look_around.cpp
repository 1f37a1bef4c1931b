#include "scene/look_around.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace airlight {
namespace {

constexpr std::size_t n = Panorama::directions;

constexpr double lowest = -0.5, highest = 0.866;  ///< heights above the horizon, as sines

/// Fibonacci's spiral on a belt of the sphere, from 30 degrees below the horizon to 60 above.
struct Directions {
  std::array<float, n> x, y, z;

  Directions() {
    constexpr double golden_angle = 2.399963229728653;
    for (std::size_t i = 0; i < n; ++i) {
      const double height = lowest + (highest - lowest) * (double(i) + 0.5) / double(n);
      const double radius = std::sqrt(1 - height * height), azimuth = golden_angle * double(i);
      x[i] = float(radius * std::cos(azimuth));
      y[i] = float(height);
      z[i] = float(radius * std::sin(azimuth));
    }
  }
};

const Directions& all_directions() {
  static const Directions directions;
  return directions;
}

/// The nearest hit of each direction as the distance's inverse; negative on a surface's back.
using Nearness = std::array<float, n>;

/// Some of the directions, from one index to before another.
struct Some {
  std::size_t begin, end;
};

/// Those that may meet the triangle abc. They rise with their index, so that few are as high above
/// the horizon as a small triangle.
Some directions_to(Vec3<float> a, Vec3<float> b, Vec3<float> c) {
  const Vec3<float> centre = (a + b + c) * (1 / 3.0F);
  const Vec3<float> ca = a - centre, cb = b - centre, cc = c - centre;
  const float radius = std::sqrt(std::max({dot(ca, ca), dot(cb, cb), dot(cc, cc)}));
  const float far = length(centre);
  if (!(radius < 0.9F * far)) return {0, n};
  // An angle is at most pi / 2 times its sine, and height changes by less than the angle.
  const float height = centre.y / far, margin = 1.6F * radius / far + 1e-3F;
  const auto index = [](float h) {
    return std::clamp((h - float(lowest)) * float(n / (highest - lowest)), 0.0F, float(n));
  };
  return {std::size_t(index(height - margin)), std::size_t(std::ceil(index(height + margin)))};
}

/// A ray from the origin meets the triangle abc where it lies on the same side of the planes
/// through the origin and each edge; its distance is the triangle's volume over the sum of the
/// three.
void add_triangle(Vec3<float> a, Vec3<float> b, Vec3<float> c, const Directions& d,
                  Nearness& nearest) {
  const Some some = directions_to(a, b, c);
  if (some.begin >= some.end) return;
  const Vec3<float> ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const float volume = dot(a, bc);
  if (volume == 0) return;
  const float inverse = 1 / volume;
  for (std::size_t i = some.begin; i < some.end; ++i) {
    const float u = ab.x * d.x[i] + ab.y * d.y[i] + ab.z * d.z[i];
    const float v = bc.x * d.x[i] + bc.y * d.y[i] + bc.z * d.z[i];
    const float w = ca.x * d.x[i] + ca.y * d.y[i] + ca.z * d.z[i];
    const float near = (u + v + w) * inverse;  // positive ahead of us, wherever the front is
    const float low = std::min(std::min(u * inverse, v * inverse), w * inverse);
    const float found = low >= 0 ? near : 0.0F;
    // The front faces the origin where the volume is negative.
    nearest[i] = found > std::abs(nearest[i]) ? (inverse < 0 ? found : -found) : nearest[i];
  }
}

void see(const Mesh& mesh, Vec3<float> from, Nearness& nearest) {
  const Directions& directions = all_directions();
  for (const auto& [i, j, k] : mesh.triangles)
    add_triangle(mesh.positions[i] - from, mesh.positions[j] - from, mesh.positions[k] - from,
                 directions, nearest);
}

void see(const Sphere& sphere, Vec3<float> from, Nearness& nearest) {
  const Vec3<double> to = sphere.centre - Vec3<double>(from);
  for (std::size_t i = 0; i < n; ++i) {
    const double along = dot(to, Panorama::direction(i));
    const double root = along * along - dot(to, to) + sphere.radius * sphere.radius;
    if (root <= 0) continue;
    const bool outside = along > std::sqrt(root);
    const double t = outside ? along - std::sqrt(root) : along + std::sqrt(root);
    const float near = t > 0 ? float(1 / t) : 0;
    if (near > std::abs(nearest[i])) nearest[i] = outside ? near : -near;
  }
}

}  // namespace

Bounds bounds_of(const std::vector<Object>& objects) {
  Bounds bounds;
  const auto include = [&](Vec3<double> low, Vec3<double> high) {
    bounds.min = {std::min(bounds.min.x, low.x), std::min(bounds.min.y, low.y),
                  std::min(bounds.min.z, low.z)};
    bounds.max = {std::max(bounds.max.x, high.x), std::max(bounds.max.y, high.y),
                  std::max(bounds.max.z, high.z)};
  };
  for (const Object& object : objects) {
    if (const auto* mesh = std::get_if<Mesh>(&object.geometry)) {
      for (const auto& p : mesh->positions) include(Vec3<double>(p), Vec3<double>(p));
    } else {
      const Sphere& sphere = std::get<Sphere>(object.geometry);
      const Vec3<double> r{sphere.radius, sphere.radius, sphere.radius};
      include(sphere.centre - r, sphere.centre + r);
    }
  }
  return bounds;
}

Vec3<double> Panorama::direction(std::size_t i) {
  const Directions& d = all_directions();
  return {d.x[i], d.y[i], d.z[i]};
}

double Panorama::enclosed() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += distance[i] < float(far_away) && front[i];
  return double(count) / double(n);
}

double Panorama::inside_out() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += distance[i] < float(far_away) && !front[i];
  return double(count) / double(n);
}

double Panorama::free_way(Vec3<double> toward) const {
  constexpr double in_view = 0.8;  // cosine: about what a picture shows
  const double far = length(toward);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (dot(direction(i), toward) < in_view * far) continue;
    sum += 1 / std::min(double(distance[i]), far);
    ++count;
  }
  return count > 0 ? count / sum : far;
}

std::vector<Panorama> look_around(const std::vector<Object>& objects,
                                  const std::vector<Vec3<double>>& points) {
  std::vector<Panorama> result(points.size());
  tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t p) {
    Nearness nearest{};
    for (const Object& object : objects)
      if (object.material.is_opaque())
        std::visit([&](const auto& g) { see(g, Vec3<float>(points[p]), nearest); },
                   object.geometry);
    result[p].from = points[p];
    for (std::size_t i = 0; i < n; ++i) {
      result[p].distance[i] = nearest[i] != 0 ? 1 / std::abs(nearest[i]) : float(far_away);
      result[p].front[i] = nearest[i] > 0;
    }
  });
  return result;
}

}  // namespace airlight
