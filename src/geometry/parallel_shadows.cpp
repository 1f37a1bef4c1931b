#include "geometry/parallel_shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "error.h"
#include "geometry/surface_filter.h"
#include "scene/box_tree.h"
#include "scene/scene.h"

namespace airlight {

namespace {

constexpr Interval<double> nothing{far_away, -far_away};
constexpr Interval<double> everything{-far_away, far_away};

/// Where the point q + t d, which moves along a line, is not further than `radius` from the origin.
Interval<double> within(Vec3<double> q, Vec3<double> d, double radius) {
  const double speed2 = dot(d, d);
  // A point that all but stands still is where it is (the sine to the axis is below 1e-12).
  if (speed2 < 1e-24) return dot(q, q) < radius * radius ? everything : nothing;
  const double middle = -dot(q, d) / speed2;
  const Vec3<double> off = q + d * middle;
  const double half2 = (radius * radius - dot(off, off)) / speed2;
  if (!(half2 > 0)) return nothing;
  return {middle - sqrt(half2), middle + sqrt(half2)};
}

/// Where a + b t >= 0.
Interval<double> at_least_zero(double a, double b) {
  if (b == 0) return a >= 0 ? everything : nothing;
  return b > 0 ? Interval<double>{-a / b, far_away} : Interval<double>{-far_away, -a / b};
}

Vec3<double> normal_of(const std::array<Vec3<double>, 3>& corners) {
  return cross(corners[1] - corners[0], corners[2] - corners[0]);
}

bool empty(Interval<double> i) { return !(i.t_enter < i.t_exit); }

Interval<double> both(Interval<double> a, Interval<double> b) {
  return {max(a.t_enter, b.t_enter), min(a.t_exit, b.t_exit)};
}

/// Of two intervals that make up one, or of which one is empty.
Interval<double> either(Interval<double> a, Interval<double> b) {
  if (empty(a)) return b;
  if (empty(b)) return a;
  return {min(a.t_enter, b.t_enter), max(a.t_exit, b.t_exit)};
}

}  // namespace

ParallelShadows::ParallelShadows(const Scene& scene, Vec3<double> travel, double start)
    : travel_(travel), start_(start) {
  std::vector<Triangle> triangles;
  for (const Object& object : scene.objects) {
    const SurfaceFilter surface(scene, object);
    if (surface.is_clear()) continue;
    if (!surface.is_opaque())
      throw Error(fmt::format(
          "object \"{}\" lets light through; exact shadows are known of opaque objects only",
          object.name));
    if (const auto* sphere = std::get_if<Sphere>(&object.geometry)) {
      add(*sphere);
      continue;
    }
    const Mesh& mesh = std::get<Mesh>(object.geometry);
    for (const auto& [a, b, c] : mesh.triangles)
      add_beyond_start({Vec3<double>(mesh.positions[a]), Vec3<double>(mesh.positions[b]),
                        Vec3<double>(mesh.positions[c])},
                       triangles);
  }
  throw_prisms(triangles);
}

void ParallelShadows::add(const Sphere& sphere) {
  const Ball ball{sphere.centre, sphere.radius};
  const double before = start_ - dot(ball.centre, travel_);  // the plane, seen from the centre
  if (before >= ball.radius) return;
  if (before <= -ball.radius) {
    balls_.push_back({ball});
    return;
  }
  // Light that starts in the sphere's section with the plane gets as far as the sphere's far side.
  const double opening = sqrt((ball.radius - before) * (ball.radius + before));
  // A cap is left of a sphere whose centre lies before the plane: it shades what a ball in the
  // plane as wide as the cap shades.
  const Ball left = before <= 0 ? ball : Ball{ball.centre + travel_ * before, opening};
  balls_.push_back({left, ball, opening});
}

/// Cuts off what lies before the plane where light starts: a triangle or two remain, or none.
void ParallelShadows::add_beyond_start(const Triangle& corners,
                                       std::vector<Triangle>& triangles) const {
  Vec3<double> kept[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3<double>&p = corners[std::size_t(i)], &q = corners[std::size_t(i + 1) % 3];
    const double at_p = dot(p, travel_) - start_, at_q = dot(q, travel_) - start_;
    if (at_p >= 0) kept[count++] = p;
    if ((at_p < 0) != (at_q < 0)) kept[count++] = p + (q - p) * (at_p / (at_p - at_q));
  }
  for (int i = 2; i < count; ++i) {
    const Triangle part = {kept[0], kept[i - 1], kept[i]};
    // Seen edge on, or no triangle at all, it shades nothing.
    if (dot(normal_of(part), travel_) != 0) triangles.push_back(part);
  }
}

void ParallelShadows::throw_prisms(std::span<const Triangle> triangles) {
  std::vector<Bounds> boxes(triangles.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (const Vec3<double>& corner : triangles[k]) boxes[k].extend(corner);
  OrderedBoxTree ordered = tree_over(boxes);
  for (const std::size_t k : ordered.order) prisms_.push_back(prism_behind(triangles[k]));
  tree_ = std::move(ordered.tree);
}

ParallelShadows::Prism ParallelShadows::prism_behind(const Triangle& corners) const {
  const auto& a = corners[0];
  const Vec3<double> normal = normal_of(corners);
  const Vec3<double> behind = dot(normal, travel_) > 0 ? normal : -normal;
  Prism prism;
  prism.faces[0] = {behind, dot(behind, a)};
  for (std::size_t i = 0; i < 3; ++i) {
    // The side is found from the lower end of the edge to the upper one, so that the prisms of
    // triangles that share the edge touch without a gap.
    Vec3<double> low = corners[i], high = corners[(i + 1) % 3];
    if (std::tie(high.x, high.y, high.z) < std::tie(low.x, low.y, low.z)) std::swap(low, high);
    const Vec3<double> side = cross(high - low, travel_);
    const double offset = dot(side, low);
    const bool inward = dot(side, corners[(i + 2) % 3]) > offset;
    prism.faces[1 + i] = {inward ? side : -side, inward ? offset : -offset};
  }
  return prism;
}

Interval<double> ParallelShadows::shaded(const Prism& prism, Vec3<double> origin,
                                         Vec3<double> direction) {
  Interval<double> result = everything;
  for (const auto& [normal, offset] : prism.faces)
    result = both(result, at_least_zero(dot(normal, origin) - offset, dot(normal, direction)));
  return result;
}

/// Where the ray is inside the cylinder along the light.
Interval<double> ParallelShadows::cylinder(Vec3<double> centre, double radius, Vec3<double> origin,
                                           Vec3<double> direction) const {
  const Vec3<double> q = origin - centre;
  return within(q - travel_ * dot(q, travel_), direction - travel_ * dot(direction, travel_),
                radius);
}

Interval<double> ParallelShadows::shaded(const Ball& ball, Vec3<double> origin,
                                         Vec3<double> direction) const {
  const Vec3<double> q = origin - ball.centre;
  const Interval<double> beyond = at_least_zero(dot(q, travel_), dot(direction, travel_));
  return either(both(cylinder(ball.centre, ball.radius, origin, direction), beyond),
                within(q, direction, ball.radius));
}

/// Where light that starts inside the sphere has not reached its far side.
Interval<double> ParallelShadows::hollow(const BallShadow& shadow, Vec3<double> origin,
                                         Vec3<double> direction) const {
  const auto& [centre, radius] = shadow.inside;
  if (!(shadow.opening > 0)) return nothing;
  return both(within(origin - centre, direction, radius),
              cylinder(centre, shadow.opening, origin, direction));
}

std::span<const Interval<double>> ParallelShadows::lit(
    Vec3<double> origin, Vec3<double> direction, double t_max,
    std::span<Interval<double>> room) const noexcept {
  std::size_t count = 0;
  const auto shade = [&](Interval<double> shadow) {
    const Interval<double> part = both(shadow, {0, t_max});
    if (!empty(part)) room[count++] = part;
  };
  // Of all that lies in the plane through the ray and the light, only what is on the light's side
  // of the ray and neither before its start nor beyond its end, seen along the light.
  const Vec3<double> normal = cross(direction, travel_);
  const Vec3<double> across = direction - travel_ * dot(direction, travel_);
  const Vec3<double> away = travel_ - direction * dot(direction, travel_);
  const double end = t_max * dot(across, across);
  const auto shades_nothing = [&](Vec3<double> middle, Vec3<double> half) {
    const Vec3<double> q = middle - origin;
    const double t = dot(across, q), t_range = half_range(across, half);
    // The three directions are known to rounding, which is all that is left of them along the
    // light.
    const Vec3<double> last_bits(1e-15, 1e-15, 1e-15);
    const double rounding = half_range(q, last_bits) + half_range(half, last_bits);
    return std::abs(dot(normal, q)) > half_range(normal, half) + rounding ||
           t + t_range < -rounding || t - t_range > end + rounding ||
           dot(away, q) > half_range(away, half) + rounding;
  };
  for_each_near(tree_, shades_nothing,
                [&](std::uint32_t k) { shade(shaded(prisms_[k], origin, direction)); });
  for (const BallShadow& ball : balls_) {
    const Interval<double> shadow = shaded(ball.ball, origin, direction);
    const Interval<double> lit = hollow(ball, origin, direction);
    if (empty(lit)) {
      shade(shadow);
    } else {
      shade({shadow.t_enter, min(shadow.t_exit, lit.t_enter)});
      shade({max(shadow.t_enter, lit.t_exit), shadow.t_exit});
    }
  }
  const std::span<Interval<double>> shadows = room.first(count);
  std::ranges::sort(shadows, {}, &Interval<double>::t_enter);

  // What is lit takes the place of shadows that are passed already.
  std::size_t parts = 0;
  double reached = 0;
  for (const auto [enter, exit] : shadows) {
    if (reached < enter) room[parts++] = {reached, enter};
    reached = max(reached, exit);
  }
  if (reached < t_max) room[parts++] = {reached, t_max};
  return room.first(parts);
}

}  // namespace airlight
