// Media side by side: what of the light that their union scatters reaches the camera, in pieces,
// against quadrature of an integrand that measures every way afresh, in every arithmetic.

#include <airlight/joined.h>
#include <airlight/section_in_pieces.h>
#include <gtest/gtest.h>

#include "support/stats.h"
#include "support/unions.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::Exact;
using test::Random;
using test::Union;
using test::Worst;

/// A box to be cut up.
struct Cell {
  Vec3<double> min{-1, -1, -1}, max{1, 1, 1};
};

double& component(Vec3<double>& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

/// [-1, 1]^3 cut into boxes that touch; some are then shrunk.
std::vector<Cell> cells(Random& random, int n) {
  std::vector<Cell> all(1);
  while (int(all.size()) < n) {
    const std::size_t i = std::size_t(random.below(int(all.size())));
    Cell rest = all[i];
    const int k = random.below(3);
    const double low = component(rest.min, k), high = component(rest.max, k);
    const double at = low + (high - low) * random.uniform(0.3, 0.7);
    component(all[i].max, k) = component(rest.min, k) = at;
    all.push_back(rest);
  }
  for (Cell& cell : all)
    if (random.below(2)) {
      const Vec3<double> middle = (cell.min + cell.max) * 0.5;
      cell = {middle + (cell.min - middle) * 0.8, middle + (cell.max - middle) * 0.8};
    }
  return all;
}

Medium any_medium(Random& random, const Cell& cell, bool grey) {
  Medium medium;
  medium.shape = Box{cell.min, cell.max};
  for (int c = 0; c < 3; ++c) {
    medium.sigma_t[c] = grey && c > 0 ? medium.sigma_t.r : random.log_uniform(0.05, 10);
    medium.sigma_s[c] = grey && c > 0 ? medium.sigma_s.r : medium.sigma_t[c] * random.uniform();
  }
  if (random.below(2)) medium.phase = HenyeyGreenstein{random.uniform(-0.8, 0.8)};
  return medium;
}

/// Boxes along the axes and a ray, as special as `kind` says.
Union any_union(Random& random, int kind, bool grey) {
  Union all;
  for (const Cell& cell : cells(random, 1 + random.below(6)))
    all.parts.push_back({test::box_body(test::point(cell.min), test::point(cell.max)),
                         any_medium(random, cell, grey)});
  all.ray = test::ray_of(test::Kind(kind % test::kinds), random);
  // From inside, or from outside towards the boxes.
  if (random.below(2)) all.ray.o = all.ray.o - all.ray.d * random.uniform(0, 3);
  all.ray.t_max = random.uniform(0.5, 5);
  return all;
}

std::vector<Medium> media_of(const Union& all) {
  std::vector<Medium> media;
  for (const Union::Part& part : all.parts) media.push_back(part.medium);
  return media;
}

/// The same ray in every lane.
template <Real F, int channels>
Section<F, channels, Joined> section_of(const Joined& joined, const test::BoxRay& ray,
                                        const Medium& first) {
  return {joined,
          {joined.point(Vec3<F>(ray.o)), joined.vector(Vec3<F>(ray.d))},
          Vec3<F>(ray.w),
          F(Scalar<F>(ray.t_max)),
          first};
}

TEST(JoinedMedia, hold_the_integral_of_what_scatters) {
  Worst worst("T of a union in double, relative error / (1 + depth)");
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const Union all = any_union(random, i, false);
    const std::vector<Medium> media = media_of(all);
    const Joined joined(media);
    auto section = section_of<double, 3>(joined, all.ray, media[0]);
    section.trace_way_out();
    for (int c = 0; c < 3; ++c) {
      const Exact base = all.least_depth(c);
      const double truth = all.integral(c, base, 0, all.ray.t_max);
      if (truth < 1e-9) continue;
      const double found =
          section.pieces.total[c] * double(std::exp(base - Exact(section.pieces.depth[c])));
      worst.see(std::abs(found / truth - 1) / (1 + double(base)), all);
    }
  }
  worst.expect_below(2.5e-13);
}

}  // namespace
}  // namespace airlight
