// Light from far away and the disc of sky it comes from.

#include "airlight/lights/directional.h"

#include <airlight/math/warp.h>
#include <gtest/gtest.h>

#include <vector>

#include "report/statistics.h"
#include "support/rays_in_a_box.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::Random;
using test::Worst;

template <class F>
class EveryArithmetic : public ::testing::Test {};
TYPED_TEST_SUITE(EveryArithmetic, test::Arithmetics, test::ArithmeticName);

std::vector<Vec3<double>> axes() {
  std::vector<Vec3<double>> all = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  // Towards -z most constructions of a frame break down.
  for (const double tilt : {1e-8, 1e-4, 1e-2})
    all.push_back(normalize(Vec3<double>(tilt, tilt, -1)));
  Random random(1);
  for (int i = 0; i < 5; ++i) all.push_back(random.direction());
  return all;
}

/// Caps from the sun's to the whole sphere.
constexpr double heights[] = {0, 1.07e-5, 1e-3, 0.1, 1, 2};

TYPED_TEST(EveryArithmetic, frames_are_orthonormal_and_right_handed) {
  using F = TypeParam;
  const double eps = double(std::numeric_limits<Scalar<F>>::epsilon());
  for (const Vec3<double>& axis : axes()) {
    const Vec3<F> n(axis);
    Vec3<F> u, v;
    orthonormal_basis(n, u, v);
    EXPECT_NEAR(lane(dot(u, u), 0), 1, 4 * eps);
    EXPECT_NEAR(lane(dot(v, v), 0), 1, 4 * eps);
    EXPECT_NEAR(lane(dot(u, v), 0), 0, 4 * eps);
    EXPECT_NEAR(lane(dot(u, n), 0), 0, 4 * eps);
    EXPECT_NEAR(lane(dot(v, n), 0), 0, 4 * eps);
    EXPECT_NEAR(lane(dot(cross(u, v), n), 0), 1, 8 * eps);
  }
}

TYPED_TEST(EveryArithmetic, stays_within_the_cap) {
  using F = TypeParam;
  const double eps = double(std::numeric_limits<Scalar<F>>::epsilon());
  for (const Vec3<double>& axis : axes())
    for (const double height : heights) {
      const Vec3<F> n(axis);
      const Vec3<double> held(lane(n.x, 0), lane(n.y, 0), lane(n.z, 0));
      for (const double x : {0., 1e-30, 0.3, 1 - 0x1p-24, 1.})
        for (const double y : {0., 0.125, 0.25, 0.7, 1 - 0x1p-24}) {
          const Vec3<F> v =
              uniform_cap(n, F(Scalar<F>(height)), Vec2<F>{F(Scalar<F>(x)), F(Scalar<F>(y))});
          for (int k = 0; k < lanes<F>; ++k) {
            const Vec3<double> found(lane(v.x, k), lane(v.y, k), lane(v.z, k));
            EXPECT_NEAR(length(found), 1, 6 * eps);
            // |v - axis| = 2 sin(angle / 2) = sqrt(2 height): the angle without the rounding of
            // its cosine, which at the sun's edge would be 1 % of the disc.
            EXPECT_NEAR(length(found - held), std::sqrt(2 * height * x),
                        4 * eps * (1 + std::sqrt(height)) + eps * std::sqrt(height / 1e-3));
          }
        }
    }
}

TEST(UniformCap, spreads_directions_evenly) {
  Random random(2);
  for (const Vec3<double>& axis : axes())
    for (const double height : heights) {
      if (height == 0) continue;
      Vec3<double> e1, e2;
      orthonormal_basis(axis, e1, e2);
      std::vector<double> depth, turn, cells;
      double mean_along = 0, mean_1 = 0, mean_2 = 0;
      const int n = 40'000;
      for (int i = 0; i < n; ++i) {
        const Vec3<double> v =
            uniform_cap(axis, height, Vec2<double>{random.uniform(), random.uniform()});
        const Vec3<double> off = v - axis;
        depth.push_back(dot(off, off) / (2 * height));  // (1 - cos) / height, to full precision
        turn.push_back(std::atan2(dot(v, e1), dot(v, e2)) / (2 * pi) + 0.5);
        cells.push_back((std::floor(std::min(depth.back(), 0.999999) * 16) + turn.back()) / 16);
        mean_along += dot(off, axis) / n;
        mean_1 += dot(v, e1) / n;
        mean_2 += dot(v, e2) / n;
      }
      const auto p = [](const std::vector<double>& numbers, int bins) {
        const Histogram h = histogram(numbers, bins, 0, 1 + 1e-9);
        EXPECT_EQ(h.outside, 0);
        return chi_squared(h.counts,
                           std::vector<double>(std::size_t(bins), double(numbers.size()) / bins))
            .p;
      };
      // Uniform over the sphere is uniform in 1 - cos (Archimedes) and in azimuth, one whatever the
      // other.
      EXPECT_GT(p(depth, 64), 1e-4) << height;
      EXPECT_GT(p(turn, 64), 1e-4) << height;
      EXPECT_GT(p(cells, 256), 1e-4) << height;
      // The mean is the axis, shortened by half the height.
      const double spread = std::sqrt(height / n);  // of a component across, at most
      EXPECT_NEAR(mean_1, 0, 4 * spread) << height;
      EXPECT_NEAR(mean_2, 0, 4 * spread) << height;
      EXPECT_NEAR(mean_along, -height / 2, 4 * height / std::sqrt(12. * n)) << height;
    }
}

TEST(UniformCap, says_the_same_in_every_arithmetic) {
  Worst worst("direction in float and lanes against double");
  Random random(3);
  for (const Vec3<double>& axis : axes())
    for (const double height : heights)
      for (int i = 0; i < 20; ++i) {
        const float h = float(height), x = float(random.uniform()), y = float(random.uniform());
        const Vec3<float> narrow(axis);
        const Vec3<double> n(narrow.x, narrow.y, narrow.z);
        const Vec3<double> truth = uniform_cap(n, double(h), Vec2<double>{x, y});
        const Vec3<float> one = uniform_cap(narrow, h, Vec2<float>{x, y});
        const Vec3<FloatBatch> many = uniform_cap(Vec3<FloatBatch>(narrow), FloatBatch(h),
                                                  Vec2<FloatBatch>{FloatBatch(x), FloatBatch(y)});
        for (int k = 0; k < 3; ++k) {
          worst.see(std::abs(one[k] - truth[k]), height);
          worst.see(std::abs(lane(many[k], 0) - truth[k]), height);
        }
      }
  worst.expect_below(1e-6);
}

TEST(Directional, knows_the_height_of_its_disc) {
  Worst worst("1 - cos of the disc's radius, relative error");
  for (const double diameter : {1e-6, 1e-3, 0.53, 1., 2., 10., 90., 180., 360.}) {
    const Directional light{.angular_diameter = diameter};
    const long double radius = (long double)(diameter) / 2 * std::acos(-1.L) / 180;
    const long double half = std::sin(radius / 2);
    worst.see(std::abs(double(light.cap_height() / (2 * half * half)) - 1), diameter);
  }
  worst.expect_below(1e-15);
  EXPECT_EQ(Directional{}.cap_height(), 0);
  EXPECT_NEAR((Directional{.angular_diameter = 180}.cap_height()), 1, 1e-15);
  EXPECT_NEAR((Directional{.angular_diameter = 0.53}.cap_height()), 1.0695e-5, 1e-9);
}

TEST(Directional, comes_from_where_it_does_not_travel_to) {
  const Directional light{.direction = {0.6, 0, -0.8}};
  EXPECT_EQ(light.toward(), Vec3<double>(-0.6, 0, 0.8));
}

}  // namespace
}  // namespace airlight
