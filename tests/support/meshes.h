#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "exact_way.h"
#include "rays_in_a_box.h"

namespace airlight::test {

/// A watertight mesh as a file would hold it.
struct TestMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// a, b, c, d anticlockwise seen from outside.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }

  Point point(std::uint32_t i) const { return {points[i][0], points[i][1], points[i][2]}; }

  /// The other side out.
  TestMesh turned() const {
    TestMesh result = *this;
    for (auto& t : result.triangles) std::swap(t[0], t[1]);
    return result;
  }

  /// Both, as one.
  friend TestMesh operator+(TestMesh a, const TestMesh& b) {
    const auto offset = std::uint32_t(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const auto& [i, j, k] : b.triangles)
      a.triangles.push_back({i + offset, j + offset, k + offset});
    return a;
  }
};

/// The prism over an outline that is seen whole from its middle (x, z), from y = low to high.
inline TestMesh prism(const std::vector<std::array<double, 2>>& outline,
                      std::array<double, 2> middle, double low, double high) {
  TestMesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double y : {low, high})
    for (const auto& [x, z] : outline) mesh.points.push_back({x, y, z});
  for (const double y : {low, high}) mesh.points.push_back({middle[0], y, middle[1]});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.quad(i, j, n + j, n + i);
    mesh.triangles.push_back({2 * n, j, i});
    mesh.triangles.push_back({2 * n + 1, n + i, n + j});
  }
  return mesh;
}

inline TestMesh box_mesh(const Vec3<double>& low, const Vec3<double>& high) {
  return prism({{low.x, low.z}, {low.x, high.z}, {high.x, high.z}, {high.x, low.z}},
               {(low.x + high.x) / 2, (low.z + high.z) / 2}, low.y, high.y);
}

/// An L of two arms, 2 m long and 1 m wide and high.
inline TestMesh l_mesh() {
  return prism({{-1, -1}, {-1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, -1}}, {-0.5, -0.5}, -0.5, 0.5);
}

/// A concave outline of n corners, drawn up.
inline TestMesh random_prism(Random& random, int n) {
  std::vector<std::array<double, 2>> outline;
  for (int i = 0; i < n; ++i) {
    const double angle = -2 * 3.141592653589793 * (i + random.uniform(0.1, 0.9)) / n;
    const double radius = random.uniform(0.2, 1);
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return prism(outline, {0, 0}, random.uniform(-1, -0.3), random.uniform(0.3, 1));
}

inline TestMesh torus(std::uint32_t around, std::uint32_t across, double radius = 0.7,
                      double thickness = 0.25) {
  TestMesh mesh;
  const auto turn = [](std::uint32_t i, std::uint32_t n) { return 2 * 3.141592653589793 * i / n; };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double r = radius + thickness * std::cos(turn(j, across));
      mesh.points.push_back({r * std::cos(turn(i, around)), thickness * std::sin(turn(j, across)),
                             r * std::sin(turn(i, around))});
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t k = (i + 1) % around, l = (j + 1) % across;
      mesh.quad(i * across + j, i * across + l, k * across + l, k * across + j);
    }
  return mesh;
}

/// Where a line crosses the mesh, and which way, triangle by triangle.
struct ExactCrossings {
  std::vector<std::pair<Exact, int>> crossings;  ///< distance; +1 out, −1 in

  ExactCrossings(const TestMesh& mesh, const Point& o, const Point& d) {
    for (const auto& [i, j, k] : mesh.triangles) {
      const Point a = mesh.point(i), b = mesh.point(j), c = mesh.point(k);
      const auto minus = [](const Point& p, const Point& q) {
        return Point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
      };
      const auto times = [](const Point& p, const Point& q) {
        return Point{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                     p[0] * q[1] - p[1] * q[0]};
      };
      // Möller and Trumbore.
      const Point ab = minus(b, a), ac = minus(c, a), ao = minus(o, a);
      const Point p = times(d, ac);
      const Exact det = dot(ab, p);
      if (det == 0) continue;
      const Exact u = dot(ao, p) / det;
      const Point q = times(ao, ab);
      const Exact v = dot(d, q) / det;
      if (u < 0 || v < 0 || u + v > 1) continue;
      crossings.push_back({dot(ac, q) / det, det < 0 ? 1 : -1});
    }
    std::ranges::sort(crossings);
  }

  /// How much of [from, to] lies inside.
  Exact inside(Exact from, Exact to) const {
    Exact sum = 0;
    int depth = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      depth -= crossings[i].second;
      if (depth > 0 && i + 1 < crossings.size())
        sum += std::max<Exact>(
            std::min(to, crossings[i + 1].first) - std::max(from, crossings[i].first), 0);
    }
    return sum;
  }
  bool is_inside(Exact t) const {
    int depth = 0;
    for (const auto& [at, turn] : crossings)
      if (at <= t) depth -= turn;
    return depth > 0;
  }
};

}  // namespace airlight::test
