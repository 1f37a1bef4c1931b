// What every placement of samples owes us, grey and in colour. A newcomer to the list is tested by
// being on it.

#include <airlight/placements.h>
#include <airlight/shapes.h>
#include <gtest/gtest.h>

#include "report/statistics.h"
#include "support/exact_way.h"
#include "support/rays_in_a_box.h"
#include "support/stats.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::BoxRay;
using test::Exact;
using test::ExactWay;
using test::Random;
using test::Worst;

using Space = Box::Space;
const Space space = Box{}.space();

/// A ray through a medium and what judges it. `strength` is what a metre of a channel scatters.
template <int channels>
struct Scene {
  BoxRay ray;
  Channels<double, channels> sigma, strength;
  ExactWay exact = test::exact(ray);

  /// T of a channel, or of a part of the ray.  [m]
  double integral(int c, double from, double to) const {
    return double(exact.integral(sigma[c], from, to) * std::exp(-sigma[c] * exact.shortest()));
  }
  double integral(int c) const { return integral(c, 0, ray.t_max); }

  friend std::ostream& operator<<(std::ostream& out, const Scene& scene) {
    out << scene.ray;
    for (int c = 0; c < channels; ++c)
      out << " sigma_t " << scene.sigma[c] << " strength " << scene.strength[c];
    return out;
  }
};

/// The same in the arithmetic at hand.
template <Real F, int channels>
Section<F, channels, Space> section_of(const Scene<channels>& scene) {
  Channels<F, channels> sigma;
  for (int c = 0; c < channels; ++c) sigma[c] = F(Scalar<F>(scene.sigma[c]));
  Section<F, channels, Space> section(space, {Vec3<F>(scene.ray.o), Vec3<F>(scene.ray.d)},
                                      Vec3<F>(scene.ray.w), F(Scalar<F>(scene.ray.t_max)), sigma);
  section.trace_way_out();
  return section;
}

template <Real F, int channels>
Channels<F, channels> strength_of(const Scene<channels>& scene) {
  Channels<F, channels> strength;
  for (int c = 0; c < channels; ++c) strength[c] = F(Scalar<F>(scene.strength[c]));
  return strength;
}

/// Media from thin to thick, of like and unlike channels, some of which scatter nothing.
template <int channels>
std::vector<Scene<channels>> scenes(int n, unsigned seed, double thickest) {
  Random random(seed);
  std::vector<Scene<channels>> all;
  while (int(all.size()) < n) {
    Scene<channels> scene{test::ray_of(test::Kind(random.below(test::kinds)), random), {}, {}};
    if (scene.ray.t_max < 0.1) continue;
    bool fine = true;
    for (int k = 0; k < 3; ++k) fine &= scene.ray.w[k] == 0 || std::abs(scene.ray.w[k]) > 1e-2;
    if (!fine) continue;
    const int like = random.below(4);
    const double sigma = random.log_uniform(0.01, thickest);
    for (int c = 0; c < channels; ++c) {
      scene.sigma[c] = like == 0 ? sigma : random.log_uniform(0.01, thickest);
      if (random.below(12) == 0) scene.sigma[c] = 0;
      scene.strength[c] = random.uniform(0.1, 1);
    }
    if (channels == 3 && random.below(4) == 0) scene.strength[random.below(3)] = 0;
    all.push_back(scene);
  }
  return all;
}

/// A placement with its settings at their defaults and near their ends.
template <class P>
std::vector<P> corners_of() {
  return {P{}};
}
template <>
std::vector<Mixed> corners_of<Mixed>() {
  std::vector<Mixed> corners = {Mixed{}};
  for (const auto partner : {Mixed::Partner::equidistant, Mixed::Partner::distance})
    for (const double part : {0.05, 0.3, 0.95}) {
      Mixed corner;
      corner.partner = partner, corner.part = part;
      corners.push_back(corner);
    }
  return corners;
}

/// In how many ascending runs a placement's samples come as u goes from 0 to 1.
template <class P>
int runs(int channels) {
  if constexpr (std::same_as<P, Equidistant>)
    return 1;
  else if constexpr (std::same_as<P, Mixed>)
    return 2 * channels;
  else
    return channels;
}

/// Calls check(scene, section, placed, placement) for grey and coloured scenes.
template <class P, class Check>
void everywhere(int n, unsigned seed, double thickest, Check&& check) {
  const auto with = [&]<int channels>(const std::vector<Scene<channels>>& all) {
    for (const P& placement : corners_of<P>())
      for (const Scene<channels>& scene : all) {
        const auto section = section_of<double>(scene);
        check(scene, section, placement.on(section, strength_of<double>(scene)), placement);
      }
  };
  with(scenes<1>(n, seed, thickest));
  with(scenes<3>(n, seed, thickest));
}

template <class P>
class EveryPlacement : public ::testing::Test {};

TYPED_TEST_SUITE(EveryPlacement, test::MembersOf<Placements>::Types, test::MemberName);

TYPED_TEST(EveryPlacement, has_a_density) {
  Worst worst("integral of the density, off one by");
  everywhere<TypeParam>(
      40, 1, 100, [&](const auto& scene, const auto& section, const auto& placed, const auto&) {
        const double t_max = scene.ray.t_max;
        const double integral = test::integrate(
            0, t_max, [&](double t) { return placed.pdf(t, section.way.length_at(t)); }, 1e-13,
            {section.way.t[1], section.way.t[2], t_max * 1e-3, t_max * (1 - 1e-3)});
        worst.see(std::abs(integral - 1), scene);
      });
  worst.expect_below(3e-11);
}

TYPED_TEST(EveryPlacement, samples_what_it_says) {
  unsigned seed = 1;
  std::vector<double> ps;
  everywhere<TypeParam>(
      12, 2, 30, [&](const auto& scene, const auto& section, const auto& placed, const auto&) {
        ps.push_back(test::chi_squared_p(
            32, 50'000, [&](double u) { return placed.sample(u); },
            [&](double t) { return placed.pdf(t, section.way.length_at(t)); }, 0, scene.ray.t_max,
            {section.way.t[1], section.way.t[2]}, seed++));
        EXPECT_GT(ps.back(), 1e-5) << scene;
      });
  // Of right samplers the p-values themselves are uniform.
  const double distance = kolmogorov_smirnov_distance(ps, [](double p) { return p; });
  EXPECT_GT(kolmogorov_smirnov_p(distance, ps.size()), 1e-3);
}

TYPED_TEST(EveryPlacement, weighs_by_its_own_density) {
  Worst worst("weight * density against the transmittance, relative error / (1 + depth)");
  Random random(3);
  everywhere<TypeParam>(
      40, 3, 100, [&](const auto& scene, const auto& section, const auto& placed, const auto&) {
        for (int i = 0; i < 20; ++i) {
          const double t = placed.sample(random.uniform()), length = section.way.length_at(t);
          const auto weights = placed.weights(t, length);
          for (int c = 0; c < int(weights.size()); ++c) {
            const double truth = double(std::exp(-scene.sigma[c] * scene.exact.length(t)));
            const double depth = scene.sigma[c] * double(scene.exact.longest());
            worst.see(std::abs(weights[c] * placed.pdf(t, length) / truth - 1) / (1 + depth),
                      scene);
          }
        }
      });
  worst.expect_below(3e-15);
}

// Within what one channel draws t goes one way, so that strata of u are strata of t; it may turn,
// or jump, where the next channel or placement takes over.
TYPED_TEST(EveryPlacement, keeps_strata) {
  everywhere<TypeParam>(
      30, 4, 100, [&](const auto& scene, const auto&, const auto& placed, const auto&) {
        int turns = 0;
        double before = 0, way = 1;
        for (int i = 0; i <= 2000; ++i) {
          const double t = placed.sample(i / 2000.);
          ASSERT_TRUE(t >= 0 && t <= scene.ray.t_max) << scene;
          if ((t - before) * way < -1e-12) ++turns, way = -way;
          before = t;
        }
        EXPECT_LE(turns, 2 * (runs<TypeParam>(int(scene.sigma.size())) - 1)) << scene;
      });
}

/// z-scores of the two sums of a scene, half in the shadow, against the exact integrals.
template <class Scene, class Section, PlacedOn<Section> Placed>
void judge(const Scene& scene, const Section& section, const Placed& placed, Random& random,
           std::vector<double>& z, Worst& noise) {
  constexpr int n = 64, seeds = 1500;
  constexpr int channels = Section::channels;
  const double from = scene.ray.t_max * random.uniform(0, 0.6);
  const double to = from + (scene.ray.t_max - from) * random.uniform(0.2, 0.9);
  std::array<std::vector<double>, channels> lit, all;
  for (int seed = 0; seed < seeds; ++seed) {
    Channels<double, channels> occluded{}, unoccluded{};
    for (int i = 0; i < n; ++i) {
      const double t = placed.sample((i + random.uniform()) / n);
      const auto weights = placed.weights(t, section.way.length_at(t));
      for (int c = 0; c < channels; ++c) {
        unoccluded[c] += weights[c] / n;
        if (t < from || t > to) occluded[c] += weights[c] / n;
      }
    }
    for (int c = 0; c < channels; ++c) {
      lit[c].push_back(occluded[c]);
      all[c].push_back(unoccluded[c]);
    }
  }
  for (int c = 0; c < channels; ++c) {
    if (scene.strength[c] == 0) continue;  // may be as noisy as it likes: it counts for nothing
    const double truth = scene.integral(c), shadow = scene.integral(c, from, to);
    z.push_back(test::z_score(lit[c], truth - shadow, 1e-12 * truth));
    z.push_back(test::z_score(all[c], truth, 1e-12 * truth));
    EXPECT_LT(std::abs(z.rbegin()[0]), 4.5) << scene << " channel " << c << " unoccluded";
    EXPECT_LT(std::abs(z.rbegin()[1]), 4.5)
        << scene << " channel " << c << " but for " << from << " to " << to;
    noise.see(standard_error(lit[c]) / truth, scene);
  }
}

TYPED_TEST(EveryPlacement, is_unbiased_in_both_sums) {
  std::vector<double> z;
  Worst noise("standard error of the lit sum / T");
  Random random(5);
  everywhere<TypeParam>(
      8, 5, 4, [&](const auto& scene, const auto& section, const auto& placed, const auto&) {
        judge(scene, section, placed, random, z, noise);
      });
  // Where the sum has no noise z is rounding; elsewhere it is normal.
  std::erase_if(z, [](double score) { return std::abs(score) < 1e-3; });
  EXPECT_NEAR(mean(z), 0, 4 / std::sqrt(double(z.size())));
  EXPECT_NEAR(standard_deviation(z), 1, 4 / std::sqrt(2. * double(z.size())));
  noise.expect_below(2e-3);  // or the test would see nothing
}

TYPED_TEST(EveryPlacement, says_the_same_in_every_arithmetic) {
  // A sample in float must be one that double draws within 4e-6 of u: at the seam between two
  // channels they may fall on different sides. Weights are compared at the same t.
  Worst sample("sample outside of what double draws nearby, off by / t_max");
  Worst lane_sample("sample of a lane outside of what double draws nearby, off by / t_max");
  Worst weight("weight in float, relative error / (1 + depth)");
  Worst lane_weight("weight in a lane, relative error / (1 + depth)");
  Random random(6);
  const auto with = [&]<int channels>(std::vector<Scene<channels>> all) {
    for (Scene<channels> scene : all) {
      scene.ray = test::narrowed(scene.ray);
      for (int c = 0; c < channels; ++c)
        scene.sigma[c] = test::narrowed(scene.sigma[c]),
        scene.strength[c] = test::narrowed(scene.strength[c]);
      const auto in_double = section_of<double>(scene);
      const auto in_float = section_of<float>(scene);
      const auto in_lanes = section_of<FloatBatch>(scene);
      for (const TypeParam& placement : corners_of<TypeParam>()) {
        const auto truth = placement.on(in_double, strength_of<double>(scene));
        const auto one = placement.on(in_float, strength_of<float>(scene));
        const auto many = placement.on(in_lanes, strength_of<FloatBatch>(scene));
        for (int i = 0; i < 16; ++i) {
          const float u = float(random.uniform());
          double low = scene.ray.t_max, high = 0;
          for (const double shift : {-4e-6, -2e-6, -1e-6, 0., 1e-6, 2e-6, 4e-6}) {
            const double t = truth.sample(std::clamp(u + shift, 0., 1.));
            low = std::min(low, t), high = std::max(high, t);
          }
          const float t = one.sample(u);
          const float lane_t = lane(many.sample(FloatBatch(u)), lanes<FloatBatch> - 1);
          const auto outside = [&](double x) {
            return std::max({low - x, x - high, 0.}) / scene.ray.t_max;
          };
          sample.see(outside(t), scene);
          lane_sample.see(outside(lane_t), scene);

          const auto wanted = truth.weights(t, in_double.way.length_at(t));
          const auto found = one.weights(t, in_float.way.length_at(t));
          const FloatBatch ts(t);
          const auto lane_found = many.weights(ts, in_lanes.way.length_at(ts));
          for (int c = 0; c < channels; ++c) {
            double depth = 0;
            for (const double sigma : scene.sigma)
              depth = std::max(depth, sigma * double(scene.exact.longest()));
            weight.see(std::abs(found[c] / wanted[c] - 1) / (1 + depth), scene);
            lane_weight.see(std::abs(double(lane(lane_found[c], 0)) / wanted[c] - 1) / (1 + depth),
                            scene);
          }
        }
      }
    }
  };
  with(scenes<1>(60, 7, 10));
  with(scenes<3>(60, 8, 10));
  sample.expect_below(1e-6);
  lane_sample.expect_below(1e-6);
  weight.expect_below(2e-6);
  lane_weight.expect_below(2e-6);
}

TYPED_TEST(EveryPlacement, survives_odd_numbers) {
  static constexpr double sigmas[] = {0, 1e-38, 1e-30, 1e-7, 1e-3, 1, 10, 1e3, 1e6};
  static constexpr double strengths[] = {0, 0, 1e-30, 1e-3, 1, 1e5};
  static constexpr double ends[] = {0, 1e-30, 1e-10, 1e-3, 1, 1, 1, 1};
  Random random(9);
  const auto with = [&]<Real F, int channels>(F, std::integral_constant<int, channels>) {
    for (int round = 0; round < 3000; ++round) {
      Scene<channels> scene{test::ray_of(test::Kind(random.below(test::kinds)), random), {}, {}};
      scene.ray.t_max = std::min(scene.ray.t_max, random.of(ends));
      double scatters = 0;
      for (int c = 0; c < channels; ++c) {
        scene.sigma[c] = random.of(sigmas);
        scatters += scene.strength[c] = random.of(strengths);
      }
      const auto section = section_of<F>(scene);
      const auto placements = corners_of<TypeParam>();
      const TypeParam& placement = placements[std::size_t(random.below(int(placements.size())))];
      const auto placed = placement.on(section, strength_of<F>(scene));
      for (const double u : {0., 1e-30, 0.4, 1 - 0x1p-24, 1.}) {
        const F t = placed.sample(F(Scalar<F>(u))), length = section.way.length_at(t);
        const auto weights = placed.weights(t, length);
        for (int k = 0; k < lanes<F>; ++k) {
          ASSERT_TRUE(lane(t, k) >= 0 && lane(t, k) <= lane(section.t_max, k))
              << scene << " u " << u << " t " << lane(t, k);
          for (int c = 0; c < channels; ++c) {
            const double carried = lane(weights[c], k) * scene.strength[c];
            ASSERT_TRUE(carried >= 0 && carried < 1e30)
                << scene << " u " << u << " channel " << c << " weight " << lane(weights[c], k);
          }
        }
      }
    }
  };
  using One = std::integral_constant<int, 1>;
  using Three = std::integral_constant<int, 3>;
  with(1., One{}), with(1., Three{});
  with(1.f, One{}), with(1.f, Three{});
  with(FloatBatch(1), One{}), with(FloatBatch(1), Three{});
}

// --- what some of them promise besides ----------------------------------------------------------

TEST(WholeVolume, weighs_every_sample_alike_where_channels_are_alike) {
  Worst worst("weight against T, relative error / (1 + depth)");
  Random random(10);
  for (const Scene<3>& coloured : scenes<3>(100, 10, 30)) {
    Scene<3> scene = coloured;
    scene.sigma[1] = scene.sigma[2] = scene.sigma[0];
    scene.strength = {0.3, 1, 0};
    const auto section = section_of<double>(scene);
    const auto placed = WholeVolume{}.on(section, scene.strength);
    const double depth = scene.sigma[0] * double(scene.exact.longest());
    for (int i = 0; i < 10; ++i) {
      const double t = placed.sample(random.uniform());
      for (const double w : placed.weights(t, section.way.length_at(t)))
        worst.see(std::abs(w / scene.integral(0) - 1) / (1 + depth), scene);
    }
  }
  worst.expect_below(1e-14);
}

TEST(WholeVolume, has_bounded_weights_in_colour) {
  Random random(11);
  double tightest = 0;
  for (const Scene<3>& scene : scenes<3>(200, 11, 30)) {
    const auto section = section_of<double>(scene);
    const auto placed = WholeVolume{}.on(section, scene.strength);
    double carried = 0;
    for (int c = 0; c < 3; ++c) carried += scene.strength[c] * scene.integral(c);
    for (int i = 0; i < 100; ++i) {
      const double t = i == 0 ? 0 : placed.sample(random.uniform());
      const auto weights = placed.weights(t, section.way.length_at(t));
      for (int c = 0; c < 3; ++c) {
        if (scene.strength[c] == 0) continue;
        // T over the chance to draw from this channel, which is what it carries over the sum.
        const double bound = carried / scene.strength[c];
        ASSERT_LE(weights[c], bound * (1 + 1e-10)) << scene << " channel " << c << " at " << t;
        tightest = std::max(tightest, weights[c] / bound);
      }
    }
  }
  EXPECT_GT(tightest, 0.9);  // the bound is not idle
}

TEST(Distance, has_bounded_weights_in_colour) {
  Random random(12);
  for (const Scene<3>& scene : scenes<3>(200, 12, 30)) {
    const auto section = section_of<double>(scene);
    const auto placed = Distance{}.on(section, scene.strength);
    Channels<double, 3> norm;
    double carried = 0;
    for (int c = 0; c < 3; ++c) {
      const double depth = scene.sigma[c] * scene.ray.t_max;
      norm[c] = scene.ray.t_max * (depth > 0 ? -std::expm1(-depth) / depth : 1);
      carried += scene.strength[c] * norm[c];
    }
    for (int i = 0; i < 50; ++i) {
      const double t = placed.sample(random.uniform());
      const auto weights = placed.weights(t, section.way.length_at(t));
      for (int c = 0; c < 3; ++c) {
        if (scene.strength[c] == 0) continue;
        ASSERT_LE(weights[c], carried / scene.strength[c] * (1 + 1e-10)) << scene;
      }
    }
  }
}

TEST(Mixed, never_weighs_more_than_either_part_of_it) {
  const auto with = [&]<int channels>(const std::vector<Scene<channels>>& all) {
    Random random(13);
    for (const Scene<channels>& scene : all) {
      const auto section = section_of<double>(scene);
      for (const Mixed& mix : corners_of<Mixed>()) {
        const auto placed = mix.on(section, scene.strength);
        const auto whole = WholeVolume{}.on(section, scene.strength);
        const auto equidistant = Equidistant{}.on(section, scene.strength);
        const auto distance = Distance{}.on(section, scene.strength);
        for (int i = 0; i < 20; ++i) {
          const double t = placed.sample(random.uniform()), length = section.way.length_at(t);
          const auto weights = placed.weights(t, length), a = whole.weights(t, length),
                     b = mix.partner == Mixed::Partner::distance ? distance.weights(t, length)
                                                                 : equidistant.weights(t, length);
          for (int c = 0; c < channels; ++c) {
            ASSERT_LE(weights[c], a[c] / (1 - mix.part) * (1 + 1e-10)) << scene;
            ASSERT_LE(weights[c], b[c] / mix.part * (1 + 1e-10)) << scene;
          }
        }
      }
    }
  };
  with(scenes<1>(60, 14, 30));
  with(scenes<3>(60, 15, 30));
}

}  // namespace
}  // namespace airlight
