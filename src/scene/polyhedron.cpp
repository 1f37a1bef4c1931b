#include "scene/polyhedron.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "error.h"
#include "scene/bounds.h"
#include "scene/direction.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;
using Planes = std::vector<Plane>;

constexpr double tolerance = 1e-6;  ///< of the size: coordinates are often given with six digits

/// Whether some direction leads out of sight without crossing a plane. If the normals do not lie in
/// a plane, such directions form a cone whose edges are parallel to two planes each.
bool is_endless(const Planes& planes) {
  constexpr double parallel = 1e-12;
  bool spans = false;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec edge = cross(planes[i].n, planes[j].n);
      if (length(edge) < parallel) continue;
      double most = 0, least = 0;
      for (const Plane& plane : planes) {
        const double climb = dot(plane.n, normalize(edge));
        most = std::max(most, climb);
        least = std::min(least, climb);
      }
      spans |= std::max(most, -least) > parallel;
      if (most <= parallel || least >= -parallel) return true;
    }
  return !spans;
}

/// Where three planes meet and no other cuts the point off, each point once for every three planes.
/// Normals that span less than `least_volume` meet nowhere: the less they span, the less certain is
/// the point, and whether it is cut off.
std::vector<Vec> corners_of(const Planes& planes, double least_volume = 1e-12) {
  std::vector<Vec> corners;
  double farthest = 0;
  for (const Plane& plane : planes) farthest = std::max(farthest, std::abs(plane.h));
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Plane &a = planes[i], &b = planes[j], &c = planes[k];
        const Vec bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
        const double volume = dot(a.n, bc);
        if (std::abs(volume) < least_volume) continue;
        const Vec p = (a.h * bc + b.h * ca + c.h * ab) * (1 / volume);
        const double slack = 1e-12 * (farthest + length(p)) / std::abs(volume);
        const auto cuts_off = [&](const Plane& plane) { return dot(plane.n, p) - plane.h > slack; };
        if (std::ranges::none_of(planes, cuts_off)) corners.push_back(p);
      }
  return corners;
}

Vec mean_of(const std::vector<Vec>& points) {
  Bounds bounds;
  for (const Vec& p : points) bounds.extend(p);
  const Vec middle = bounds.centre();
  Vec sum;  // about the middle: no digits are lost far from the origin
  for (const Vec& p : points) sum = sum + (p - middle);
  return middle + sum * (1.0 / double(points.size()));
}

double farthest_from(const Vec& centre, const std::vector<Vec>& points) {
  double farthest = 0;
  for (const Vec& p : points) farthest = std::max(farthest, length(p - centre));
  return farthest;
}

/// Of planes with the same normal the lowest counts.
Planes without_duplicates(const Planes& planes) {
  Planes kept;
  for (const Plane& plane : planes) {
    const auto same = std::ranges::find_if(
        kept, [&](const Plane& other) { return length(other.n - plane.n) < 1e-12; });
    if (same == kept.end())
      kept.push_back(plane);
    else
      same->h = std::min(same->h, plane.h);
  }
  return kept;
}

/// A plane is a face if corners lie on it that do not lie on one line.
bool is_face(const Plane& plane, const std::vector<Vec>& corners, double size) {
  const double near = 1e-9 * size;
  const Vec* first = nullptr;
  Vec along;
  for (const Vec& p : corners) {
    if (std::abs(dot(plane.n, p) - plane.h) > near) continue;
    if (!first)
      first = &p;
    else if (length(along) < near)
      along = p - *first;
    else if (length(cross(along, p - *first)) > near * length(along))
      return true;
  }
  return false;
}

void check_face_count(const Planes& planes) {
  if (planes.size() > Convex::max_faces)
    throw Error(fmt::format("make more than {} faces: accepted are up to {}", Convex::max_faces,
                            Convex::max_faces));
}

Convex closed_polyhedron(Planes planes) {
  planes = without_duplicates(planes);
  if (is_endless(planes)) throw Error("leave a side open: the polyhedron must be closed");
  const std::vector<Vec> corners = corners_of(planes);
  if (corners.empty()) throw Error("leave nothing: no point is inside all planes");
  Convex convex;
  convex.centre = mean_of(corners);
  const double size = farthest_from(convex.centre, corners);
  for (const Plane& plane : planes)
    if (plane.h - dot(plane.n, convex.centre) < 1e-9 * size || size == 0)
      throw Error("leave no volume: the polyhedron is flat");
  std::erase_if(planes, [&](const Plane& plane) { return !is_face(plane, corners, size); });
  check_face_count(planes);
  convex.face_count = int(planes.size());
  std::ranges::copy(planes, convex.faces.begin());
  return convex;
}

}  // namespace

Convex polyhedron_inside(const std::vector<std::array<double, 4>>& numbers) {
  if (numbers.size() > most_planes)
    throw Error(fmt::format("are {}: accepted are up to {}", numbers.size(), most_planes));
  Planes planes;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto& [x, y, z, h] = numbers[i];
    const auto n = unit_vector({x, y, z});
    if (!n) throw Error(fmt::format("have no direction in element {}: n must not be 0", i));
    planes.push_back({*n, h / (x * n->x + y * n->y + z * n->z)});
  }
  return closed_polyhedron(std::move(planes));
}

bool overlap(const Convex& a, const Convex& b) {
  // Both about the same point and shrunk a little: what they share, if anything, has corners.
  const auto planes_of = [](const Convex& body) {
    Planes planes;
    for (int k = 0; k < body.face_count; ++k)
      planes.push_back({body.faces[k].n, body.faces[k].h - dot(body.faces[k].n, body.centre)});
    return planes;
  };
  const auto size_of = [&](const Convex& body) {
    return farthest_from({}, corners_of(planes_of(body)));
  };
  const Vec between = b.centre - a.centre;
  const double size_a = size_of(a), size_b = size_of(b);
  if (length(between) >= size_a + size_b) return false;
  Planes both = planes_of(a);
  for (const Plane& plane : planes_of(b))
    both.push_back({plane.n, plane.h + dot(plane.n, between)});
  for (Plane& plane : both) plane.h -= tolerance * std::min(size_a, size_b);
  // Faces that touch are parallel but for rounding. What is not flat has other corners than theirs.
  constexpr double certain = 1e-5;
  return !corners_of(both, certain).empty();
}

Convex hull_of(const std::vector<Vec>& given) {
  if (given.size() < 4) throw Error("are too few: a polyhedron takes at least 4");
  if (given.size() > most_hull_points)
    throw Error(fmt::format("are {}: accepted are up to {}", given.size(), most_hull_points));
  const Vec middle = mean_of(given);
  std::vector<Vec> points;
  for (const Vec& p : given) points.push_back(p - middle);
  const double size = farthest_from({}, points), near = tolerance * size;

  Planes planes;
  const auto lies_on = [&](const Vec& p, const Plane& plane) {
    return std::abs(dot(plane.n, p) - plane.h) <= near;
  };
  const auto add_if_outside = [&](const Vec& a, const Vec& n) {
    double h = dot(n, a);
    for (const Vec& p : points) {
      const double above = dot(n, p);
      if (above > dot(n, a) + near) return;
      h = std::max(h, above);
    }
    if (planes.size() > Convex::max_faces) return;
    planes.push_back({n, h});
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Vec &a = points[i], &b = points[j], &c = points[k];
        const Vec area = cross(b - a, c - a);
        if (length(area) <= near * size) continue;  // all but on a line
        const auto on_one = [&](const Plane& plane) {
          return lies_on(a, plane) && lies_on(b, plane) && lies_on(c, plane);
        };
        if (std::ranges::any_of(planes, on_one)) continue;
        add_if_outside(a, normalize(area));
        add_if_outside(a, -normalize(area));
      }
  if (planes.empty()) throw Error("span no volume: they all but lie on a line");
  check_face_count(planes);  // the list ends there, and would leave a side open
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (dot(planes[i].n, planes[j].n) < -1 + tolerance && planes[i].h + planes[j].h <= 2 * near)
        throw Error("span no volume: they all but lie in a plane");
  Convex convex = closed_polyhedron(std::move(planes));
  convex.centre = convex.centre + middle;
  for (int k = 0; k < convex.face_count; ++k) convex.faces[k].h += dot(convex.faces[k].n, middle);
  return convex;
}

}  // namespace airlight
