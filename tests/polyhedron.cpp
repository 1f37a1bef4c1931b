// Convex media from planes and from points.

#include "scene/polyhedron.h"

#include <gmock/gmock.h>

#include <random>

#include "support/error_of.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;
using Planes = std::vector<std::array<double, 4>>;
using test::error_of;
using ::testing::HasSubstr;

const Planes cube_planes = {{1, 0, 0, 1},  {-2, 0, 0, 2}, {0, 5, 0, 5},
                            {0, -1, 0, 1}, {0, 0, 1, 1},  {0, 0, -1, 1}};

std::vector<Vec> cube_points(double half = 1, Vec centre = {}) {
  std::vector<Vec> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(centre +
                     Vec{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  return points;
}

/// With the golden ratio written out in six digits, as files do.
std::vector<Vec> dodecahedron_points() {
  constexpr double phi = 1.618034, inverse = 0.618034;
  std::vector<Vec> points = cube_points();
  for (const double a : {-inverse, inverse})
    for (const double b : {-phi, phi})
      for (const Vec& p : {Vec{0, a, b}, Vec{a, b, 0}, Vec{b, 0, a}}) points.push_back(p);
  return points;
}

double above(const Convex& convex, Vec p) {
  double most = -1e300;
  for (int k = 0; k < convex.face_count; ++k)
    most = std::max(most, dot(convex.faces[k].n, p) - convex.faces[k].h);
  return most;
}

}  // namespace

TEST(Polyhedron, takes_normals_of_any_length) {
  const Convex cube = polyhedron_inside(cube_planes);
  ASSERT_EQ(cube.face_count, 6);
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(length(cube.faces[k].n), 1, 1e-15);
    EXPECT_NEAR(cube.faces[k].h, 1, 1e-15);
  }
  EXPECT_LT(length(cube.centre), 1e-14);
}

TEST(Polyhedron, drops_planes_that_touch_nothing) {
  Planes planes = cube_planes;
  planes.push_back({1, 0, 0, 3});    // behind a face
  planes.push_back({2, 0, 0, 2});    // the same face again
  planes.push_back({1, 1, 1, 3});    // touches a corner
  planes.push_back({1, 1, 0, 100});  // far out
  EXPECT_EQ(polyhedron_inside(planes).face_count, 6);
  planes.push_back({1, 1, 1, 2.5});  // cuts a corner off
  EXPECT_EQ(polyhedron_inside(planes).face_count, 7);
}

TEST(Polyhedron, counts_its_faces_when_the_planes_that_touch_nothing_are_gone) {
  const auto ring = [](int count, double h) {
    Planes planes = {{0, 0, 1, 1}, {0, 0, -1, 1}};
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count;
      planes.push_back({std::cos(angle), std::sin(angle), 0, h});
    }
    return planes;
  };
  Planes planes = cube_planes;
  for (const auto& plane : ring(100, 3)) planes.push_back(plane);
  EXPECT_EQ(polyhedron_inside(planes).face_count, 6);
  EXPECT_EQ(polyhedron_inside(ring(62, 1)).face_count, 64);
  EXPECT_EQ(error_of([&] { polyhedron_inside(ring(63, 1)); }),
            "make more than 64 faces: accepted are up to 64");
  EXPECT_EQ(error_of([&] { polyhedron_inside(ring(255, 1)); }), "are 257: accepted are up to 256");
}

TEST(Polyhedron, stands_anywhere) {
  Planes planes = cube_planes;
  for (auto& [x, y, z, h] : planes) h += 1e6 * x - 2e6 * y + 3e6 * z;
  const Convex cube = polyhedron_inside(planes);
  EXPECT_EQ(cube.face_count, 6);
  EXPECT_LT(length(cube.centre - Vec{1e6, -2e6, 3e6}), 1e-6);
}

TEST(Polyhedron, refuses_what_has_no_end) {
  Planes open = cube_planes;
  open.pop_back();
  const auto error_with = [](const Planes& planes) {
    return error_of([&] { polyhedron_inside(planes); });
  };
  const std::string endless = "leave a side open: the polyhedron must be closed";
  EXPECT_EQ(error_with(open), endless);
  EXPECT_EQ(error_with({}), endless);
  EXPECT_EQ(error_with({{1, 0, 0, 1}, {-1, 0, 0, 1}}), endless);                  // a slab
  EXPECT_EQ(error_with({{1, 0, 0, 1}, {-1, 1, 0, 1}, {-1, -1, 0, 1}}), endless);  // a prism
  EXPECT_EQ(error_with({{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}), endless);     // a corner
}

TEST(Polyhedron, refuses_what_has_no_inside) {
  const auto error_with = [](double h) {
    Planes planes = cube_planes;
    planes.push_back({-1, -1, -1, h});
    return error_of([&] { polyhedron_inside(planes); });
  };
  EXPECT_EQ(error_with(-3.1), "leave nothing: no point is inside all planes");
  EXPECT_THAT(error_with(-3), HasSubstr("flat"));  // a corner alone
  EXPECT_EQ(error_with(-2.9), "");
  Planes planes = cube_planes;
  planes[1] = {-1, 0, 0, -1};
  EXPECT_THAT(error_of([&] { polyhedron_inside(planes); }), HasSubstr("flat"));
  EXPECT_THAT(error_of([] { polyhedron_inside({{0, 0, 0, 1}}); }), HasSubstr("element 0"));
}

TEST(Polyhedron, is_the_hull_of_points) {
  const Convex cube = hull_of(cube_points(2, {10, 20, 30}));
  EXPECT_EQ(cube.face_count, 6);
  EXPECT_LT(length(cube.centre - Vec{10, 20, 30}), 1e-12);
  EXPECT_NEAR(above(cube, {13, 20, 30}), 1, 1e-12);
  EXPECT_NEAR(above(cube, {10, 20, 30}), -2, 1e-12);
}

TEST(Polyhedron, merges_faces_of_points_given_in_six_digits) {
  const Convex dodecahedron = hull_of(dodecahedron_points());
  EXPECT_EQ(dodecahedron.face_count, 12);
  for (const Vec& p : dodecahedron_points()) EXPECT_LE(above(dodecahedron, p), 1e-12);
}

TEST(Polyhedron, passes_over_points_inside_and_on_faces) {
  std::vector<Vec> points = cube_points();
  for (const Vec& p : cube_points(0.5)) points.push_back(p);
  points.push_back({1, 0, 0});
  points.push_back({1, 1, 0.3});
  points.push_back(points[0]);
  EXPECT_EQ(hull_of(points).face_count, 6);
}

TEST(Polyhedron, holds_every_point_of_a_random_cloud) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec> points;
    for (int i = 0; i < 12; ++i)
      points.push_back({number(random), number(random), number(random) + 100});
    const Convex hull = hull_of(points);
    int on_faces = 0;
    for (const Vec& p : points) {
      EXPECT_LE(above(hull, p), 1e-11);
      on_faces += above(hull, p) > -1e-5;
    }
    EXPECT_GE(on_faces, 4);
    EXPECT_GE(hull.face_count, 4);
  }
}

TEST(Polyhedron, touches_another_where_they_share_corners_in_single_precision) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 50; ++round) {
    const Vec x = normalize(Vec{number(random), number(random), number(random)});
    const Vec y = normalize(cross(x, Vec{number(random), number(random), number(random)}));
    const auto slab = [&](double from, double to) {
      std::vector<Vec> points;
      for (const Vec& p : cube_points()) {
        const Vec q = x * (p.x < 0 ? from : to) + y * p.y + cross(x, y) * p.z;
        points.push_back({float(q.x), float(q.y), float(q.z)});
      }
      return hull_of(points);
    };
    const Convex left = slab(-1, 0.3);
    EXPECT_FALSE(overlap(left, slab(0.3, 1))) << round;
    EXPECT_TRUE(overlap(left, slab(0.3 - 1e-5, 1))) << round;
  }
}

TEST(Polyhedron, refuses_points_that_span_nothing) {
  const auto error_with = [](const std::vector<Vec>& points) {
    return error_of([&] { hull_of(points); });
  };
  EXPECT_THAT(error_with({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("too few"));
  EXPECT_THAT(error_with({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), HasSubstr("in a plane"));
  EXPECT_THAT(error_with({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), HasSubstr("on a line"));
  EXPECT_THAT(error_with({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), HasSubstr("on a line"));
  std::vector<Vec> ball;
  for (int i = 0; i < 60; ++i) {
    const double z = 1 - (2 * i + 1) / 60., r = std::sqrt(1 - z * z);
    ball.push_back({r * std::cos(2.4 * i), r * std::sin(2.4 * i), z});
  }
  EXPECT_THAT(error_with(ball), HasSubstr("more than 64 faces"));
}

}  // namespace airlight
