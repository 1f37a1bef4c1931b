#pragma once
#include <gtest/gtest.h>

#include "analog_walk.h"

namespace airlight::test {

/// A mean and its standard error, by order of scattering and colour; [0] has scattered once.
template <int orders>
struct ByOrder {
  double mean[orders][3] = {}, error[orders][3] = {};
};

/// Means that are meant to be the same: expects them within four standard errors of each other and
/// says how far apart they lie at most, in standard errors. Floats may be off by 4e-6 of the light
/// that scatters once, the error of the closed form.
template <int orders>
double expect_alike(const ByOrder<orders>& a, const ByOrder<orders>& b) {
  double worst = 0;
  for (int k = 0; k < orders; ++k)
    for (int c = 0; c < 3; ++c) {
      const double error = std::hypot(a.error[k][c], b.error[k][c], 4e-6 * b.mean[0][c]);
      const double z = std::abs(a.mean[k][c] - b.mean[k][c]) / error;
      EXPECT_LT(z, 4) << "order " << k + 1 << ", channel " << c << ": " << a.mean[k][c] << " +- "
                      << a.error[k][c] << " and " << b.mean[k][c] << " +- " << b.error[k][c];
      worst = std::max(worst, z);
    }
  return worst;
}

/// What stands in the fog of the walks.
inline const Colour floor_colour{0.7, 0.5, 0.3};
inline constexpr double ball_grey = 0.6;

inline Object floor_of_the_walks() {
  const double half = AnalogWalk::floor_half;
  const Sheet floor{.corner = {-half, AnalogWalk::floor_height, -half},
                    .right = {0, 0, 2 * half},
                    .up = {2 * half, 0, 0},
                    .albedo = floor_colour};
  return floor.object("floor");
}

inline Object ball_of_the_walks() {
  Material grey;
  grey.albedo = Colour(ball_grey);
  return {"ball", Sphere{{0, 0, 0}, AnalogWalk::ball_radius}, grey};
}

/// What plain walks give for colour c of a picture of one row, in the light of its sun.
template <int orders>
void walk_through(const Scene& scene, AnalogWalk walk, int c, unsigned seed,
                  ByOrder<orders>& result) {
  static_assert(orders <= AnalogWalk::orders);
  const auto& sun = std::get<Directional>(scene.lights[0]);
  walk.sun = -sun.direction, walk.irradiance = sun.irradiance[c];
  constexpr int walks = 150000;
  std::mt19937_64 random(seed);
  double sum[orders] = {}, squares[orders] = {};
  for (int pixel = 0; pixel < scene.resolution.width; ++pixel)
    for (int i = 0; i < walks; ++i) {
      const auto light = walk(camera_ray(scene, pixel + 0.5, 0.5), random);
      for (int k = 0; k < orders; ++k) {
        const double x = light[std::size_t(k)];
        sum[k] += x, squares[k] += x * x;
      }
    }
  const double n = double(scene.resolution.width) * walks;
  for (int k = 0; k < orders; ++k) {
    const double mean = sum[k] / n;
    result.mean[k][c] = mean;
    result.error[k][c] = std::sqrt((squares[k] / n - mean * mean) / n);
  }
}

}  // namespace airlight::test
