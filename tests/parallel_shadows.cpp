// Exact shadows in parallel light against shadow rays in double.

#include "geometry/parallel_shadows.h"

#include <gmock/gmock.h>

#include "error.h"
#include "geometry/world.h"
#include "support/random.h"

namespace airlight {
namespace {

using ::testing::ElementsAre;

Object ball(Vec3<double> centre, double radius) { return {"ball", Sphere{centre, radius}, {}}; }

/// A tetrahedron, closed or (now and then) with a face missing.
Object tetrahedron(test::Random& random) {
  Mesh mesh;
  const Vec3<double> centre = random.in_the_cube();
  for (int i = 0; i < 4; ++i)
    mesh.positions.push_back(Vec3<float>(centre + random.in_the_cube() * 0.5));
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  if (random.uniform() < 0.3) mesh.triangles.pop_back();
  return {"tetrahedron", mesh, {}};
}

/// So many that they fill a tree of some depth.
Object shards(test::Random& random) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3<double> centre = random.in_the_cube();
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back(Vec3<float>(centre + random.in_the_cube() * 0.1));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {"shards", mesh, {}};
}

Scene any_scene(unsigned seed) {
  test::Random random(seed);
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    scene.objects.push_back(ball(random.in_the_cube(), random.uniform(0.05, 0.4)));
    scene.objects.push_back(tetrahedron(random));
  }
  if (seed % 8 < 2) scene.objects.push_back(shards(random));
  return scene;
}

std::vector<Interval<double>> lit(const ParallelShadows& shadows, Vec3<double> origin,
                                  Vec3<double> direction, double t_max) {
  std::vector<Interval<double>> room(shadows.most_parts());
  room.resize(shadows.lit(origin, direction, t_max, room).size());
  return room;
}

TEST(ParallelShadows, agree_with_shadow_rays) {
  int asked = 0, dark = 0, parts = 0;
  for (unsigned seed = 1; seed <= 32; ++seed) {
    const Scene scene = any_scene(seed);
    const World world(scene, Visibility::analytic);
    test::Random random(seed + 1000);
    const Vec3<double> travel = seed % 4 ? random.direction() : Vec3<double>(0, -1, 0);
    // The plane where light starts cuts some of the objects.
    const double start = seed % 2 ? -far_away : dot(random.in_the_cube() * 0.7, travel);
    const ParallelShadows shadows(scene, travel, start);
    for (int k = 0; k < 100; ++k) {
      const Vec3<double> origin = random.in_the_cube() * 2;
      // Camera rays along the light are their own case.
      const Vec3<double> direction = k % 10 == 0   ? travel
                                     : k % 10 == 1 ? -travel
                                                   : normalize(random.in_the_cube() * 0.7 - origin);
      const double reach = dot(origin, travel) - start, nearing = dot(direction, travel);
      if (reach < 0) continue;
      double t_max = random.uniform(1, 5);
      if (nearing < 0) t_max = std::min(t_max, reach / -nearing);
      const auto parts_lit = lit(shadows, origin, direction, t_max);
      std::vector<double> ends = {0, t_max};
      for (const auto& [from, to] : parts_lit) {
        ASSERT_LT(from, to);
        ASSERT_TRUE(ends.size() == 2 || from > ends.back());
        ends.insert(ends.end(), {from, to});
      }
      parts += int(parts_lit.size());
      std::vector<double> ts;
      for (int i = 0; i < 100; ++i) ts.push_back(random.uniform(0, t_max));
      // Just inside and outside of every end.
      for (const double end : ends) ts.insert(ts.end(), {end - 1e-7, end + 1e-7});
      for (const double t : ts) {
        if (t < 0 || t > t_max) continue;
        double nearest = far_away;
        bool expected = false;
        for (const auto& [from, to] : parts_lit) expected = expected || (t > from && t < to);
        for (const double end : ends) nearest = std::min(nearest, std::abs(t - end));
        if (nearest < 1e-9) continue;
        const Rgb<double> light =
            world.transmit(origin + direction * t, -travel, reach + nearing * t, 0, true);
        ASSERT_EQ(light.g, expected ? 1 : 0) << seed << ' ' << k << ' ' << t;
        ++asked;
        dark += !expected;
      }
    }
  }
  // The comparison must mean something.
  EXPECT_GT(asked, 200'000);
  EXPECT_GT(dark, asked / 20);
  EXPECT_GT(parts, 2200);
}

TEST(ParallelShadows, of_a_sphere_is_half_a_cylinder) {
  Scene scene;
  scene.objects = {ball({0, 0, 0}, 1)};
  const ParallelShadows shadows(scene, {0, -1, 0});
  const auto parts = [&](Vec3<double> origin) {
    std::vector<std::pair<double, double>> result;
    for (const auto& [from, to] : lit(shadows, origin, {1, 0, 0}, 10))
      result.emplace_back(from, to);
    return result;
  };
  using Pair = std::pair<double, double>;
  EXPECT_THAT(parts({-3, -2, 0}), ElementsAre(Pair(0, 2), Pair(4, 10)));
  EXPECT_THAT(parts({-3, 2, 0}), ElementsAre(Pair(0, 10)));
  // Above the equator the sphere itself is dark inside.
  EXPECT_THAT(parts({-3, 0.6, 0}), ElementsAre(Pair(0, 3 - 0.8), Pair(3 + 0.8, 10)));
  EXPECT_THAT(parts({-3, -2, 1.5}), ElementsAre(Pair(0, 10)));
}

TEST(ParallelShadows, leave_no_gap_where_triangles_meet) {
  // A ceiling of many triangles over a long ray: one shadow.
  test::Random random(4);
  Mesh mesh;
  const int n = 30;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      mesh.positions.push_back({float(i) / n + float(random.uniform(0, 0.02)),
                                float(random.uniform(1, 1.2)), float(j) / n});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto at = [&](int k, int l) { return std::uint32_t((i + k) * (n + 1) + j + l); };
      mesh.triangles.push_back({at(0, 0), at(1, 0), at(0, 1)});
      mesh.triangles.push_back({at(1, 0), at(1, 1), at(0, 1)});
    }
  Scene scene;
  scene.objects = {{"ceiling", mesh, {}}};
  const ParallelShadows shadows(scene, normalize(Vec3<double>(0.1, -1, 0.03)));
  for (int k = 0; k < 1000; ++k) {
    const Vec3<double> from(random.uniform(0.3, 0.7), random.uniform(0, 0.5),
                            random.uniform(0.3, 0.7));
    const Vec3<double> to(random.uniform(0.3, 0.7), random.uniform(0, 0.5),
                          random.uniform(0.3, 0.7));
    EXPECT_THAT(lit(shadows, from, to - from, 1), ElementsAre());
  }
}

TEST(ParallelShadows, are_refused_for_glass_and_not_cast_by_what_does_nothing) {
  Scene scene;
  scene.objects = {ball({0, 0, 0}, 1)};
  scene.objects[0].material.opacity = 0;
  EXPECT_EQ(lit(ParallelShadows(scene, {0, -1, 0}), {0, -2, 0}, {1, 0, 0}, 1).size(), 1);
  scene.objects[0].material.opacity = 0.5;
  try {
    ParallelShadows(scene, {0, -1, 0});
    FAIL() << "glass is accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "object \"ball\" lets light through; exact shadows are known of opaque objects only");
  }
}

}  // namespace
}  // namespace airlight
