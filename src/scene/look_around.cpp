#include "scene/look_around.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace airlight {
namespace {

constexpr std::size_t n = Panorama::directions;

constexpr double golden_angle = 2.399963229728653;

constexpr double lowest = -0.5, highest = 0.866;  ///< heights above the horizon, as sines

/// Fibonacci's spiral on a belt of the sphere, from 30 degrees below the horizon to 60 above.
struct Directions {
  std::array<float, n> x, y, z;

  Directions() {
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

/// Those that may meet a ball at a height above the horizon, both as sines. They rise with their
/// index, so that few are as high as something small.
Some directions_near(float height, float radius) {
  // An angle is at most pi / 2 times its sine, and height changes by less than the angle.
  const float margin = 1.6F * radius + 1e-3F;
  const auto index = [](float h) {
    return std::clamp((h - float(lowest)) * float(n / (highest - lowest)), 0.0F, float(n));
  };
  return {std::size_t(index(height - margin)), std::size_t(std::ceil(index(height + margin)))};
}

/// Those that may meet the triangle abc.
Some directions_to(Vec3<float> a, Vec3<float> b, Vec3<float> c) {
  const Vec3<float> centre = (a + b + c) * (1 / 3.0F);
  const Vec3<float> ca = a - centre, cb = b - centre, cc = c - centre;
  const float radius = std::sqrt(std::max({dot(ca, ca), dot(cb, cb), dot(cc, cc)}));
  const float far = length(centre);
  if (!(radius < 0.9F * far)) return {0, n};
  return directions_near(centre.y / far, radius / far);
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

/// Some of a mesh's triangles, as neighbours in a file are in space, and a ball around them.
struct Chunk {
  static constexpr std::size_t most = 16;

  std::size_t begin, end;
  Vec3<float> centre;
  float radius;
};

std::vector<Chunk> chunks_of(const Mesh& mesh) {
  std::vector<Chunk> chunks;
  for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += Chunk::most) {
    const std::size_t end = std::min(begin + Chunk::most, mesh.triangles.size());
    Vec3<float> low = mesh.positions[mesh.triangles[begin][0]], high = low;
    for (std::size_t t = begin; t < end; ++t)
      for (const std::uint32_t i : mesh.triangles[t]) {
        const Vec3<float> p = mesh.positions[i];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    chunks.push_back({begin, end, (low + high) * 0.5F, 0.5F * length(high - low)});
  }
  return chunks;
}

/// Those of each object; none of a sphere.
std::vector<std::vector<Chunk>> chunks_of(const std::vector<Object>& objects) {
  std::vector<std::vector<Chunk>> chunks;
  for (const Object& object : objects) {
    const auto* mesh = std::get_if<Mesh>(&object.geometry);
    chunks.push_back(mesh ? chunks_of(*mesh) : std::vector<Chunk>());
  }
  return chunks;
}

/// Whether any of the directions may meet a ball of this radius around a point.
bool is_met(Vec3<float> centre, float radius, const Directions& d) {
  const float far = length(centre);
  if (!(radius < 0.9F * far)) return true;
  const Some some = directions_near(centre.y / far, radius / far);
  // A little wider than the ball, for rounding.
  const float sine = radius / far + 1e-3F;
  const float least = far * std::sqrt(std::max(1 - sine * sine, 0.0F));
  for (std::size_t i = some.begin; i < some.end; ++i)
    if (centre.x * d.x[i] + centre.y * d.y[i] + centre.z * d.z[i] > least) return true;
  return false;
}

void see(const Mesh& mesh, std::span<const Chunk> chunks, Vec3<float> from, Nearness& nearest) {
  const Directions& directions = all_directions();
  for (const Chunk& chunk : chunks) {
    if (!is_met(chunk.centre - from, chunk.radius, directions)) continue;
    for (std::size_t t = chunk.begin; t < chunk.end; ++t) {
      const auto& [i, j, k] = mesh.triangles[t];
      add_triangle(mesh.positions[i] - from, mesh.positions[j] - from, mesh.positions[k] - from,
                   directions, nearest);
    }
  }
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

/// Whether the ray from the origin along d meets the triangle abc: as add_triangle has it.
bool meets(Vec3<float> d, Vec3<float> a, Vec3<float> b, Vec3<float> c) {
  const Vec3<float> bc = cross(b, c);
  const float volume = dot(a, bc);
  const float u = dot(cross(a, b), d), v = dot(bc, d), w = dot(cross(c, a), d);
  return volume > 0 ? std::min({u, v, w}) >= 0 : volume < 0 && std::max({u, v, w}) <= 0;
}

bool is_in_the_way(const Mesh& mesh, std::span<const Chunk> chunks, Vec3<float> from,
                   Vec3<float> d) {
  for (const Chunk& chunk : chunks) {
    const Vec3<float> to = chunk.centre - from;
    const float along = dot(to, d), reach = 1.001F * chunk.radius;
    if (along < -reach || dot(to, to) - along * along > reach * reach) continue;
    for (std::size_t t = chunk.begin; t < chunk.end; ++t) {
      const auto& [i, j, k] = mesh.triangles[t];
      if (meets(d, mesh.positions[i] - from, mesh.positions[j] - from, mesh.positions[k] - from))
        return true;
    }
  }
  return false;
}

bool is_in_the_way(const Sphere& sphere, Vec3<float> from, Vec3<float> d) {
  const Vec3<float> to = Vec3<float>(sphere.centre) - from;
  const float along = dot(to, d), off = dot(to, to) - float(sphere.radius * sphere.radius);
  return off < 0 || (along > 0 && along * along > off);
}

}  // namespace

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
  const auto chunks = chunks_of(objects);
  std::vector<Panorama> result(points.size());
  tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t p) {
    Nearness nearest{};
    const Vec3<float> from(points[p]);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!objects[i].material.is_opaque()) continue;
      if (const auto* mesh = std::get_if<Mesh>(&objects[i].geometry))
        see(*mesh, chunks[i], from, nearest);
      else
        see(std::get<Sphere>(objects[i].geometry), from, nearest);
    }
    result[p].from = points[p];
    for (std::size_t i = 0; i < n; ++i) {
      result[p].distance[i] = nearest[i] != 0 ? 1 / std::abs(nearest[i]) : float(far_away);
      result[p].front[i] = nearest[i] > 0;
    }
  });
  return result;
}

std::vector<std::uint8_t> see_the_sky(const std::vector<Object>& objects,
                                      const std::vector<Sight>& sights) {
  const auto chunks = chunks_of(objects);
  std::vector<std::uint8_t> result(sights.size());
  tbb::parallel_for(std::size_t(0), sights.size(), [&](std::size_t s) {
    const Vec3<float> from(sights[s].from), toward(sights[s].toward);
    bool is_free = true;
    for (std::size_t i = 0; i < objects.size() && is_free; ++i) {
      if (!objects[i].material.is_opaque()) continue;
      if (const auto* mesh = std::get_if<Mesh>(&objects[i].geometry))
        is_free = !is_in_the_way(*mesh, chunks[i], from, toward);
      else
        is_free = !is_in_the_way(std::get<Sphere>(objects[i].geometry), from, toward);
    }
    result[s] = is_free;
  });
  return result;
}

double light_of_the_sky(const std::vector<Object>& objects, Vec3<double> place) {
  constexpr int count = 128;
  std::vector<Sight> sights;
  for (int i = 0; i < count; ++i) {  // as many in every direction as the cosine of its zenith angle
    const double radius = std::sqrt((i + 0.5) / count), azimuth = golden_angle * i;
    sights.push_back(
        {place,
         {radius * std::cos(azimuth), std::sqrt(1 - radius * radius), radius * std::sin(azimuth)}});
  }
  return double(std::ranges::count(see_the_sky(objects, sights), 1)) / count;
}

}  // namespace airlight
