// Light from a disc of sky in fog: what the estimators make of it against the mean over the disc.

#include <airlight/estimators/sampled.h>
#include <gtest/gtest.h>

#include "report/statistics.h"
#include "support/exact_way.h"
#include "support/rays_in_a_box.h"
#include "support/stats.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::Exact;
using test::ExactWay;
using test::point;
using test::Random;
using test::Worst;

/// A grey fog in the cube [-1, 1]^3, one camera ray in it, one disc of light.
struct Scene {
  Medium medium;
  Directional light;
  Vec3<double> o, d;
  double t_max;

  Scene(double diameter, double sigma, const Phases& phase, Vec3<double> toward, Vec3<double> eye,
        Vec3<double> view)
      : o(eye), d(view) {
    medium.sigma_t = Rgb<double>(sigma), medium.sigma_s = Rgb<double>(0.8 * sigma);
    medium.phase = phase;
    light.direction = -toward, light.irradiance = Rgb<double>(2);
    light.angular_diameter = diameter;
    t_max = double(test::exact_distance_out(test::box_body(), point(o), point(d)));
  }

  /// Radiance in parallel light from w.
  double from(const Vec3<double>& w) const {
    const ExactWay way(test::box_body(), point(o), point(d), point(w), t_max);
    const Exact sigma = medium.sigma_t.r;
    const double transmittance = double(way.integral(sigma) * std::exp(-sigma * way.shortest()));
    return medium.sigma_s.r * light.irradiance.r * transmittance *
           evaluate(medium.phase, dot(w, d));
  }

  /// Its mean over the disc, or over the half of it on the side of `edge` (an axis of the frame):
  /// midpoints in 1 − cos and in azimuth.
  double mean_over_disc(const Vec3<double>* edge = nullptr) const {
    const Vec3<double> axis = light.toward();
    const double radius = light.angular_diameter * (pi / 360);
    const double height = 2 * std::pow(std::sin(radius / 2), 2);
    Vec3<double> across = edge ? *edge : normalize(cross(axis, Vec3<double>(0.3, -0.5, 0.81)));
    const Vec3<double> other = cross(axis, across);
    constexpr int rings = 64, spokes = 64;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
      for (int k = 0; k < spokes; ++k) {
        const double h = height * (i + 0.5) / rings, turn = 2 * pi * (k + 0.5) / spokes;
        if (edge && std::cos(turn) < 0) continue;
        const double s = std::sqrt(h * (2 - h));
        sum += from(axis * (1 - h) + across * (s * std::cos(turn)) + other * (s * std::sin(turn)));
      }
    return sum / (rings * spokes);
  }
};

/// Lets through what comes from one half of the disc.
struct HalfSky {
  Vec3<double> edge;
  template <Real F>
  Rgb<F> transmit(Vec3<F>, Vec3<F> towards, F, int, Mask<F>) const {
    return Rgb<F>(select(dot(towards, Vec3<F>(edge)) > F(0), F(1), F(0)));
  }
};

/// Sums of one pixel that casts `rays` camera rays of `samples` samples each, over their number.
template <Real F, class World>
Estimate<double> pixel(const Scene& scene, const Sampled& sampled, std::uint32_t seed,
                       std::uint32_t rays, std::uint32_t samples, const World& world) {
  const auto space = Box{}.space();
  const Vec3<F> o(scene.o), d(scene.d);
  Halves<F> sums;
  const Sampler<F> sampler{UInt<F>(pixel_hash(seed, 3, 4))};
  for (std::uint32_t ray = 0; ray < rays; ++ray) {
    const MediumRay<F> medium_ray{.origin = o,
                                  .direction = d,
                                  .entry = {space.point(o), space.vector(d)},
                                  .t_enter = F(0),
                                  .t_max = F(Scalar<F>(scene.t_max)),
                                  .active = F(1) > F(0),
                                  .index = ray,
                                  .filtered = false};
    sampled.add<1>(scene.medium, space, scene.light, 0, medium_ray, {ray * samples, samples}, true,
                   sampler, world, sums);
  }
  Estimate<double> mean;
  const double n = 1. / (rays * samples);
  for (const Estimate<F>& half : sums) {
    const auto red = [&](const Rgb<F>& c) { return Rgb<double>(double(lane(c.r, 0)) * n); };
    mean += Estimate<double>{red(half.plain), red(half.analytic), red(half.occluded),
                             red(half.unoccluded)};
  }
  return mean;
}

/// Looking past the sun, into it and away from it, through phases that vary across it or not.
std::vector<Scene> scenes(double diameter, double g) {
  const Vec3<double> toward = normalize(Vec3<double>(0.48, 0.6, -0.64));
  Vec3<double> e1, e2;
  orthonormal_basis(toward, e1, e2);
  const double radius = diameter * (pi / 360);
  std::vector<Scene> all;
  for (const double off : {0., 0.5 * radius, 2 * radius, 0.8, 2.5}) {
    const Vec3<double> view = toward * std::cos(off) + (e1 * 0.6 + e2 * 0.8) * std::sin(off);
    for (const Phases& phase : {Phases(Isotropic{}), Phases(HenyeyGreenstein{g})})
      all.emplace_back(diameter, 1.3, phase, toward, Vec3<double>(0.2, -0.5, 0.4), view);
  }
  return all;
}

template <Real F>
void is_unbiased(double diameter, double g, std::uint32_t rays, std::uint32_t samples) {
  Worst noise("relative standard error");
  for (const Placements& placement : {Placements(WholeVolume{}), Placements(Equidistant{}),
                                      Placements(Distance{}), Placements(Mixed{})})
    for (const Scene& scene : scenes(diameter, g)) {
      const Sampled plain{placement, MonteCarlo{}};
      Vec3<double> edge, other;
      orthonormal_basis(scene.light.toward(), edge, other);
      std::vector<double> whole, half;
      for (std::uint32_t seed = 0; seed < 300; ++seed) {
        whole.push_back(pixel<F>(scene, plain, seed, rays, samples, Unshadowed{}).plain.r);
        half.push_back(pixel<F>(scene, plain, seed, rays, samples, HalfSky{edge}).plain.r);
      }
      const double truth = scene.mean_over_disc(), half_truth = scene.mean_over_disc(&edge);
      const double rounding = std::same_as<F, double> ? 1e-6 : 5e-6;  // 1e-6 of the midpoint rule
      EXPECT_LT(std::abs(test::z_score(whole, truth, rounding * truth)), 4.5)
          << placement.index() << " " << dot(scene.d, scene.light.toward());
      EXPECT_LT(std::abs(test::z_score(half, half_truth, rounding * truth)), 4.5)
          << placement.index() << " " << dot(scene.d, scene.light.toward());
      noise.see(standard_error(whole) / truth, diameter);
    }
  noise.expect_below(5e-3);
}

TEST(SunDisc, is_sampled_without_bias) {
  is_unbiased<double>(0.53, 0.995, 32, 1);
  is_unbiased<float>(0.53, 0.98, 32, 1);
  is_unbiased<double>(5, 0.95, 32, 1);
  is_unbiased<FloatBatch>(5, 0.9, 32, 1);
}

TEST(SunDisc, may_share_a_direction_among_samples) { is_unbiased<double>(5, 0.9, 16, 4); }

TEST(SunDisc, has_a_closed_form_for_each_of_its_directions) {
  // Deep fog, a sharp phase function and light along two faces, where the disc's centre is off by
  // percents.
  std::vector<Scene> all = scenes(5, 0.9);
  for (Scene& scene : scenes(0.53, 0.98)) all.push_back(std::move(scene));
  all.emplace_back(0.53, 8, Isotropic{}, Vec3<double>(0, 1, 0), Vec3<double>(0.995, -0.9, -1),
                   normalize(Vec3<double>(0.001, 0.1, 1)));
  EXPECT_GT(std::abs(all.back().from({0, 1, 0}) / all.back().mean_over_disc() - 1), 0.01);
  for (const Scene& scene : all) {
    std::vector<double> analytic;
    for (std::uint32_t seed = 0; seed < 800; ++seed)
      analytic.push_back(
          pixel<double>(scene, Sampled{WholeVolume{}, Ratio{}}, seed, 64, 1, Unshadowed{})
              .analytic.r);
    const double truth = scene.mean_over_disc();
    EXPECT_LT(std::abs(test::z_score(analytic, truth, 1e-5 * truth)), 4.5);
    EXPECT_LT(test::relative_standard_error(analytic), 5e-4);
  }
}

}  // namespace
}  // namespace airlight
