// Distances drawn in proportion to the transmittance of the whole way: their distribution, their
// density and their rounding.

#include <airlight/shapes.h>
#include <airlight/way_out.h>
#include <gtest/gtest.h>

#include "report/statistics.h"
#include "support/exact_way.h"
#include "support/quadrature.h"
#include "support/rays_in_a_box.h"
#include "support/stats.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::BoxRay;
using test::Exact;
using test::ExactWay;
using test::Random;
using test::Worst;

const Box::Space space = Box{}.space();

/// A ray with its way out and its trapezoids in double, and what judges them.
struct Drawn {
  BoxRay ray;
  double sigma;
  WayOut<double, 3> way = space.way_out<double>({ray.o, ray.d}, space.outward(ray.w), ray.t_max);
  Trapezoids<double, 3> light{way, sigma};
  ExactWay exact = test::exact(ray);
  Exact whole = exact.integral(sigma);  ///< relative to the shortest way
  double depth = sigma * double(exact.longest());

  /// The part of the integral before t.
  double distribution(double t) const { return double(exact.integral(sigma, 0, t) / whole); }
  /// Its density.  [1/m]
  double density(double t) const {
    return double(std::exp(sigma * (exact.shortest() - exact.length(t))) / whole);
  }

  friend std::ostream& operator<<(std::ostream& out, const Drawn& d) {
    return out << d.ray << " sigma_t " << d.sigma;
  }
};

/// `n` of every kind of ray, with any extinction at which the depth stays below `deepest`.
std::vector<Drawn> drawn(int n, double least, unsigned seed, double deepest = 1e9) {
  Random random(seed);
  std::vector<Drawn> all;
  for (const BoxRay& ray : test::rays_of_every_kind(n, least, seed)) {
    if (ray.t_max == 0) continue;
    double sigma = test::any_sigma(random);
    const double longest = double(test::exact(ray).longest());
    while (sigma * longest > deepest) sigma = test::any_sigma(random);
    all.push_back({ray, sigma});
  }
  return all;
}

TEST(WholeVolume, has_a_density) {
  Worst worst("integral of the density, off one by");
  for (const Drawn& d : drawn(120, 1e-3, 1)) {
    std::vector<double> breaks(d.way.t, d.way.t + 4);
    for (double t = d.ray.t_max / 4; t > d.ray.t_max * 1e-7; t /= 8)
      breaks.insert(breaks.end(), {t, d.ray.t_max - t});
    const double integral = test::integrate(
        0, d.ray.t_max, [&](double t) { return d.light.pdf(double(d.exact.length(t)), d.sigma); },
        1e-13, breaks);
    worst.see(std::abs(integral - 1), d);
  }
  worst.expect_below(3e-11);
}

TEST(WholeVolume, knows_the_density_of_its_samples) {
  Worst worst("density of a sample, relative error / (1 + depth)");
  Random random(2);
  for (const Drawn& d : drawn(120, 1e-3, 2))
    for (int i = 0; i < 8; ++i) {
      const double t = d.light.sample(d.way, random.uniform());
      const double density = d.light.pdf(d.way.length_at(t), d.sigma);
      worst.see(std::abs(density / d.density(t) - 1) / (1 + d.depth), d);
    }
  worst.expect_below(1e-14);
}

TEST(WholeVolume, inverts_its_distribution_in_order) {
  Worst worst("distribution of a sample, off u by");
  Random random(3);
  for (const Drawn& d : drawn(120, 1e-3, 3)) {
    std::vector<double> us = {0, 0x1p-53, 1e-9, 1 - 1e-9, 1 - 1e-16, 1};
    for (int i = 0; i < 58; ++i) us.push_back(random.uniform());
    std::ranges::sort(us);
    double before = 0;
    for (const double u : us) {
      const double t = d.light.sample(d.way, u);
      ASSERT_GE(t, before) << d << " u " << u;
      ASSERT_LE(t, d.ray.t_max) << d << " u " << u;
      before = t;
      worst.see(std::abs(d.distribution(t) - u), d);
    }
  }
  worst.expect_below(3e-11);
}

TEST(WholeVolume, draws_what_it_says) {
  std::vector<double> ps;
  for (const Drawn& d : drawn(4, 1e-3, 4, 30)) {
    unsigned seed = unsigned(ps.size()) + 1;
    ps.push_back(test::chi_squared_p(
        32, 50'000, [&](double u) { return d.light.sample(d.way, u); },
        [&](double t) { return d.density(t); }, 0, d.ray.t_max, {d.way.t[1], d.way.t[2]}, seed));
    EXPECT_GT(ps.back(), 1e-4) << d;
  }
  EXPECT_GE(ps.size(), 60u);
  // Of right samplers the p-values themselves are uniform.
  const double distance = kolmogorov_smirnov_distance(ps, [](double p) { return p; });
  EXPECT_GT(kolmogorov_smirnov_p(distance, ps.size()), 1e-3);
}

TEST(WholeVolume, draws_from_a_part_of_the_way) {
  Worst worst("distribution of a sample of a part, off u by");
  Random random(5);
  for (const Drawn& d : drawn(30, 1e-3, 5)) {
    double from = d.ray.t_max * random.uniform(), to = d.ray.t_max * random.uniform();
    if (from > to) std::swap(from, to);
    const auto part = d.way.clipped(from, to);
    const Trapezoids<double, 3> light(part, d.sigma);
    const Exact whole = d.exact.integral(d.sigma, from, to);
    // Where the part holds next to nothing the truth itself is the difference of great depths.
    if (!(whole > d.whole * 1e-6) || to - from < 1e-6) continue;
    for (const double u : {0., 0.1, 0.5, 0.77, 1.}) {
      const double t = light.sample(part, u);
      ASSERT_TRUE(t >= from && t <= to) << d;
      worst.see(std::abs(double(d.exact.integral(d.sigma, from, t) / whole) - u), d);
    }
  }
  worst.expect_below(3e-11);
}

/// float and its batch: samples judged by how far u would have to move to give them exactly.
template <Real F>
void keeps_its_accuracy() {
  Worst worst("distribution of a sample, off u by");
  Worst density("density of a sample, relative error / (1 + depth)");
  Random random(6);
  for (const Drawn& wide : drawn(100, 1e-2, 6, 20)) {
    const Drawn d{test::narrowed(wide.ray), test::narrowed(wide.sigma)};
    const F t_max(float(d.ray.t_max)), sigma(float(d.sigma));
    const LocalRay<F> ray{Vec3<F>(d.ray.o), Vec3<F>(d.ray.d)};
    const auto way = space.way_out(ray, space.outward(Vec3<F>(d.ray.w)), t_max);
    const Trapezoids<F, 3> light(way, sigma);
    for (int i = 0; i < 8; ++i) {
      float us[lanes<F>];
      for (float& u : us) u = i == 0 ? 0 : i == 1 ? 1 - 0x1p-24f : float(random.uniform());
      const F t = light.sample(way, load<F>(us));
      const F pdf = light.pdf(way.length_at(t), sigma);
      for (int k = 0; k < lanes<F>; ++k) {
        const double found = lane(t, k);
        ASSERT_TRUE(found >= 0 && found <= d.ray.t_max) << d;
        worst.see(std::abs(d.distribution(found) - us[k]), d);
        density.see(std::abs(lane(pdf, k) / d.density(found) - 1) / (1 + d.depth), d);
      }
    }
  }
  worst.expect_below(5e-6);
  density.expect_below(4e-6);
}

TEST(WholeVolume, keeps_its_accuracy_in_float) { keeps_its_accuracy<float>(); }
TEST(WholeVolume, keeps_its_accuracy_in_every_lane) { keeps_its_accuracy<FloatBatch>(); }

TEST(WholeVolume, draws_from_a_polyhedron) {
  // An octahedron, cut by two planes and named twice.
  Convex convex;
  const auto add = [&](double x, double y, double z, double h) {
    convex.faces[std::size_t(convex.face_count++)] = {normalize(Vec3<double>(x, y, z)), h};
  };
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) add(x, y, z, 0.8), add(x, y, z, 0.8);
  add(0, 0.2, 1, 0.6), add(1, -0.3, 0.1, 0.7);
  test::Body body;
  for (int k = 0; k < convex.face_count; ++k)
    body.push_back({test::point(convex.faces[std::size_t(k)].n), convex.faces[std::size_t(k)].h});
  const Convex::Space inside = convex.space();
  Worst worst("distribution of a sample, off u by");
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> o = random.in_the_cube() * 0.3, d = random.direction(),
                       w = random.direction();
    const double t_max = double(test::exact_distance_out(body, test::point(o), test::point(d)));
    const double sigma = random.log_uniform(1e-3, 1e3);
    const auto way = inside.way_out<double>({o, d}, inside.outward(w), t_max);
    const Trapezoids<double, Convex::Space::max_segments> light(way, sigma);
    const ExactWay exact(body, test::point(o), test::point(d), test::point(w), t_max);
    for (const double u : {0., 0.01, 0.3, 0.5, 0.9, 1.}) {
      const double t = light.sample(way, u);
      worst.see(std::abs(double(exact.integral(sigma, 0, t) / exact.integral(sigma)) - u), i);
    }
  }
  worst.expect_below(3e-11);
}

TEST(WholeVolume, draws_the_entry_where_there_is_no_way) {
  const auto way =
      space.way_out<double>({{0.1, 0.2, 0.3}, {1, 0, 0}}, space.outward(Vec3<double>(0, 1, 0)), 0.);
  const Trapezoids<double, 3> light(way, 2.);
  EXPECT_EQ(light.transmittance_integral(), 0);
  for (const double u : {0., 0.5, 1.}) EXPECT_EQ(light.sample(way, u), 0);
}

}  // namespace
}  // namespace airlight
