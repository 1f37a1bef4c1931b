#include "scene/objects/shattered_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/dice.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;

constexpr double gravity = 9.81;   // [m/s2]
constexpr double friction = 0.6;   // of rubble on a floor
constexpr double crack_speed = 5;  // how much faster than the pieces the crack runs outwards

/// A point of the wall's face.
struct Point {
  double x, y;

  Point operator-(const Point& other) const { return {x - other.x, y - other.y}; }
};
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double distance(Point a, Point b) { return std::sqrt(dot(a - b, a - b)); }

using Polygon = std::vector<Point>;  // convex, counterclockwise

/// Points of the face, each the loneliest of a few drawn evenly; near the impact they are allowed
/// closer.
std::vector<Point> scatter(const ShatteredWallObject& wall, Point impact, Dice& dice) {
  constexpr int candidates = 12;
  std::vector<Point> points;
  while (std::ssize(points) < wall.pieces) {
    Point best{};
    double loneliest = -1;
    for (int i = 0; i < candidates; ++i) {
      const Point p{dice() * wall.width, dice() * wall.height};
      double nearest = std::numeric_limits<double>::infinity();
      for (const Point& other : points) nearest = std::min(nearest, distance(p, other));
      const double lonely = nearest / (1 + 1.5 * distance(p, impact) / wall.radius);
      if (lonely <= loneliest && i > 0) continue;
      loneliest = lonely;
      best = p;
    }
    points.push_back(best);
  }
  return points;
}

/// The part of a polygon where dot(p, normal) ≤ offset.
Polygon clip(const Polygon& polygon, Point normal, double offset) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double from = dot(a, normal) - offset, to = dot(b, normal) - offset;
    if (from <= 0) result.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const double t = from / (from - to);
      result.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return result;
}

/// What of the face is nearer to point i than to any other: its Voronoi cell.
Polygon cell(const ShatteredWallObject& wall, const std::vector<Point>& points, std::size_t i) {
  Polygon polygon{{0, 0}, {wall.width, 0}, {wall.width, wall.height}, {0, wall.height}};
  const Point p = points[i];
  double reach = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < points.size() && !polygon.empty(); ++j) {
    const Point q = points[j];
    if (j == i || distance(p, q) > 2 * reach) continue;
    polygon = clip(polygon, q - p, 0.5 * (dot(q, q) - dot(p, p)));
    reach = 0;
    for (const Point& corner : polygon) reach = std::max(reach, distance(p, corner));
  }
  return polygon;
}

Point centroid(const Polygon& polygon) {
  double area = 0, x = 0, y = 0;
  const Point o = polygon[0];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point a = polygon[i] - o, b = polygon[i + 1] - o;
    const double twice = a.x * b.y - a.y * b.x;
    area += twice;
    x += twice * (a.x + b.x) / 3;
    y += twice * (a.y + b.y) / 3;
  }
  return area > 0 ? Point{o.x + x / area, o.y + y / area} : o;
}

/// How far from the impact a point lies: 0 there, 1 on the rim of the hole, which is ragged about
/// the wall's radius.
class Part {
 public:
  Part(const ShatteredWallObject& wall, Dice& dice)
      : impact_{wall.impact[0], wall.impact[1]}, radius_(wall.radius) {
    for (double& phase : phases_) phase = dice.between(0, 2 * pi);
  }

  double operator()(Point p) const {
    const Point away = p - impact_;
    const double azimuth = std::atan2(away.y, away.x);
    double rim = 1;
    for (int k = 0; k < 3; ++k)
      rim += amplitudes_[k] * std::sin((k + 2) * azimuth + phases_[std::size_t(k)]);
    return distance(p, impact_) / (radius_ * rim);
  }

 private:
  static constexpr double amplitudes_[] = {0.12, 0.08, 0.06};
  Point impact_;
  double radius_;
  std::array<double, 3> phases_;
};

/// v turned about a unit axis by an angle in radians (Rodrigues).
Vec turned(const Vec& v, const Vec& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

/// Where a piece is: its corners relative to its middle are turned, then moved.
struct Pose {
  Vec middle;
  Vec axis{1, 0, 0};
  double angle = 0;

  Vec operator()(const Vec& corner) const { return middle + turned(corner, axis, angle); }
};

/// How far below its middle a piece reaches.
double depth_below(const Pose& pose, const std::vector<Vec>& corners) {
  double lowest = 0;
  for (const Vec& corner : corners)
    lowest = std::min(lowest, turned(corner, pose.axis, pose.angle).y);
  return -lowest;
}

/// How long something thrown upwards takes to a place that lies lower.  [s]
double fall_time(double upwards, double drop) {
  return (upwards + std::sqrt(upwards * upwards + 2 * gravity * drop)) / gravity;
}

/// A loose piece some time after the blow: it flies as it was thrown, turning evenly so that it
/// meets the floor nearly flat, and slides until friction has stopped it.
Pose fly(const ShatteredWallObject& wall, double part, Point middle,
         const std::vector<Vec>& corners, Dice dice) {
  const Point away = middle - Point{wall.impact[0], wall.impact[1]};
  const double speed = wall.speed * (1 - 0.75 * part * part) * dice.between(0.75, 1.25);
  const Vec aside{away.x / wall.radius, away.y / wall.radius, 0};
  const Vec jitter{dice.between(-0.2, 0.2), dice.between(-0.1, 0.3), dice.between(-0.2, 0.2)};
  const Vec velocity = normalize(Vec{0, 0.1, 1} + aside * 0.5 + jitter) * speed;

  Pose pose{.middle = {middle.x, middle.y, 0}};
  pose.axis = normalize(Vec{1, dice.between(-0.25, 0.25), dice.between(-0.25, 0.25)});
  const double half_turns = std::floor(dice.between(0, 1 + 3 * fall_time(velocity.y, middle.y)));
  const double final_angle = (away.y > 0 ? 1 : -1) * pi * (0.5 + half_turns);
  const double since = wall.time - part * wall.radius / (crack_speed * wall.speed);
  if (since <= 0) return pose;

  pose.angle = final_angle;
  // Even from a place just above the floor it takes a moment to fall over.
  const double landing =
      std::max(0.2, fall_time(velocity.y, std::max(0., middle.y - depth_below(pose, corners))));
  const double flight = std::min(since, landing);
  pose.angle = final_angle * flight / landing;
  pose.middle = pose.middle + velocity * flight;
  pose.middle.y -= 0.5 * gravity * flight * flight;

  const Vec along{velocity.x, 0, velocity.z};
  const double slow_down = friction * gravity;
  const double slide = std::clamp(since - landing, 0., length(along) / slow_down);
  if (slide > 0)
    pose.middle =
        pose.middle + along * slide - normalize(along) * (0.5 * slow_down * slide * slide);
  // What starts so low that it cannot turn flat above the floor lies on it.
  pose.middle.y = std::max(pose.middle.y, depth_below(pose, corners));
  return pose;
}

/// Adds a polygon as thick as the wall: its back, its front and the sides between.
void add_piece(Mesh& mesh, const ShatteredWallObject& wall, const Polygon& polygon, Point middle,
               const Pose& pose, const std::vector<Vec>& corners) {
  const auto n = std::uint32_t(polygon.size());
  const auto corner = [&](std::size_t i) {
    mesh.positions.emplace_back(pose(corners[i]));
    mesh.uvs.push_back({float((middle.x + corners[i].x) / wall.width),
                        float((middle.y + corners[i].y) / wall.height)});
    return std::uint32_t(mesh.positions.size() - 1);
  };
  const std::uint32_t back = corner(0);
  for (std::uint32_t i = 1; i < 2 * n; ++i) corner(i);
  const std::uint32_t front = back + n;
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({back, back + i + 1, back + i});
    mesh.triangles.push_back({front, front + i, front + i + 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({back + i, back + next, front + next});
    mesh.triangles.push_back({back + i, front + next, front + i});
  }
}

}  // namespace

Parts ShatteredWallObject::build(const Cursor&) const {
  Dice dice{std::uint32_t(seed)};
  const Point centre{impact[0], impact[1]};
  const std::vector<Point> points = scatter(*this, centre, dice);
  const Part part(*this, dice);
  Mesh mesh;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Dice own{mix_bits(std::uint32_t(seed) ^ mix_bits(std::uint32_t(i)))};
    const Polygon polygon = cell(*this, points, i);
    if (polygon.size() < 3) continue;
    const Point middle = centroid(polygon);
    std::vector<Vec> corners;  // relative to the middle: the back's, then the front's
    for (const double z : {-thickness / 2, thickness / 2})
      for (const Point& p : polygon) corners.push_back({p.x - middle.x, p.y - middle.y, z});
    const bool is_loose = time > 0 && part(middle) < 1;
    const Pose pose = is_loose ? fly(*this, part(middle), middle, corners, own)
                               : Pose{.middle = {middle.x, middle.y, 0}};
    add_piece(mesh, *this, polygon, middle, pose, corners);
  }
  return single_part(std::move(mesh));
}

}  // namespace airlight
