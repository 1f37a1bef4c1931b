// What every phase function owes us. A newcomer to the list is tested by being on it.

#include <airlight/phases.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "support/quadrature.h"
#include "support/stats.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::integrate;
using test::Worst;

template <class P>
std::ostream& put(std::ostream& out, const P& phase) {
  out << P::name;
  P::describe(
      [&](const char* key, auto member, auto&&...) { out << " " << key << " " << phase.*member; });
  return out;
}

/// A phase as a failure shows it.
template <class P>
struct Shown {
  const P& phase;
  friend std::ostream& operator<<(std::ostream& out, const Shown& s) { return put(out, s.phase); }
};

/// Every parameter at its default, near both ends of its range, between, and close to the middle,
/// where a formula may divide by nearly nothing.
template <class P>
std::vector<P> corners_of() {
  std::vector<P> corners = {P{}};
  P::describe([&](const char*, auto member, const char*, const Range& range, auto&&...) {
    for (const double part : {0.005, 0.25, 0.4995, 0.50004, 0.50006, 0.505, 0.8, 0.995}) {
      P corner;
      corner.*member = range.low + (range.high - range.low) * part;
      corners.push_back(corner);
    }
  });
  return corners;
}

template <class P>
auto density(const P& phase) {
  return [&phase](double c) { return 2 * pi * phase(c); };
}

/// F(c) of cos θ, summed from the side on which c lies.
template <class P>
double distribution(const P& phase, double c) {
  return c < 0 ? integrate(-1, c, density(phase)) : 1 - integrate(c, 1, density(phase));
}

template <class P>
class EveryPhase : public ::testing::Test {};

TYPED_TEST_SUITE(EveryPhase, test::MembersOf<Phases>::Types, test::MemberName);

TYPED_TEST(EveryPhase, is_a_density_over_the_sphere) {
  for (const TypeParam& phase : corners_of<TypeParam>())
    EXPECT_NEAR(integrate(-1, 1, density(phase)), 1, 1e-11) << Shown<TypeParam>{phase};
}

TYPED_TEST(EveryPhase, is_nowhere_negative) {
  for (const TypeParam& phase : corners_of<TypeParam>())
    for (int i = -1000; i <= 1000; ++i)
      EXPECT_GT(phase(i * 1e-3), 0) << Shown<TypeParam>{phase} << " at " << i * 1e-3;
}

TYPED_TEST(EveryPhase, samples_what_it_says) {
  for (const TypeParam& phase : corners_of<TypeParam>())
    EXPECT_GT(test::chi_squared_p(
                  256, 1'000'000, [&](double u) { return phase.sample(u); }, density(phase)),
              1e-4)
        << Shown<TypeParam>{phase};
}

TYPED_TEST(EveryPhase, samples_by_inverting_its_distribution) {
  // What cos θ itself resolves near the lobe is not the sampler's fault: eps * density.
  Worst worst("distribution of a sample, off u by");
  for (const TypeParam& phase : corners_of<TypeParam>())
    for (int i = 0; i <= 200; ++i) {
      const double u = i / 200., c = phase.sample(u);
      ASSERT_TRUE(c >= -1 && c <= 1) << Shown<TypeParam>{phase} << " u " << u << " gives " << c;
      worst.see(std::abs(distribution(phase, c) - u) - 4e-16 * density(phase)(c),
                Shown<TypeParam>{phase});
    }
  worst.expect_below(2e-12);
}

TYPED_TEST(EveryPhase, spans_all_angles_in_order) {
  const auto check = [](const auto& phase, auto zero) {
    using F = decltype(zero);
    constexpr F eps = std::numeric_limits<F>::epsilon();
    EXPECT_NEAR(phase.sample(F(0)), -1, 4 * eps);
    EXPECT_NEAR(phase.sample(F(1)), 1, 4 * eps);
    F before = -1;
    for (int i = 0; i <= 4096; ++i) {
      const F c = phase.sample(F(i) / F(4096));
      ASSERT_GE(c + 4 * eps, before) << Shown<TypeParam>{phase} << " at " << i << " / 4096";
      ASSERT_TRUE(c >= -1 && c <= 1) << Shown<TypeParam>{phase} << " at " << i << " / 4096";
      before = c;
    }
  };
  for (const TypeParam& phase : corners_of<TypeParam>()) check(phase, 0.), check(phase, 0.f);
}

TYPED_TEST(EveryPhase, says_the_same_in_every_arithmetic) {
  Worst value("value in float, relative error"), sample("sample in float, off u by");
  Worst lane_value("value in a lane against float, relative difference");
  Worst lane_sample("sample in a lane, off u by");
  for (const TypeParam& phase : corners_of<TypeParam>()) {
    const Shown<TypeParam> shown{phase};
    for (int i = 0; i < 512; i += lanes<FloatBatch>) {
      float cosines[lanes<FloatBatch>], us[lanes<FloatBatch>];
      for (int k = 0; k < lanes<FloatBatch>; ++k) {
        cosines[k] = float(2 * (i + k) / 511. - 1);
        us[k] = std::min(float((i + k) / 511.), 1.f);
        cosines[k] = std::min(cosines[k], 1.f);
      }
      const FloatBatch values = phase(load<FloatBatch>(cosines));
      const FloatBatch samples = phase.sample(load<FloatBatch>(us));
      for (int k = 0; k < lanes<FloatBatch>; ++k) {
        const float one = phase(cosines[k]);
        value.see(std::abs(one / phase(double(cosines[k])) - 1), shown);
        lane_value.see(std::abs(double(lane(values, k)) / one - 1), shown);
        const auto off = [&](float c) {
          return std::abs(distribution(phase, double(c)) - us[k]) - 2e-7 * density(phase)(c);
        };
        sample.see(off(phase.sample(us[k])), shown);
        lane_sample.see(off(lane(samples, k)), shown);
      }
    }
  }
  value.expect_below(6e-7);
  sample.expect_below(2e-7);
  lane_value.expect_below(
      6e-7);  // two roundings more where one of them multiplies and adds in one step
  lane_sample.expect_below(2e-7);
}

TYPED_TEST(EveryPhase, is_found_by_its_family) {
  for (const TypeParam& phase : corners_of<TypeParam>())
    EXPECT_EQ(evaluate(Phases(phase), 0.3), phase(0.3));
}

TEST(Phases, have_names_of_their_own) {
  std::set<std::string> names;
  const auto add = [&]<class... P>(std::variant<P...>*) {
    (names.insert(P::name), ...);
    EXPECT_EQ(names.size(), sizeof...(P));
    EXPECT_FALSE((std::string(P::meaning).empty() || ...));
  };
  add(static_cast<Phases*>(nullptr));
}

TEST(HenyeyGreenstein, is_the_formula_of_1941) {
  for (const double g : {-0.99, -0.5, -1e-3, 0., 1e-3, 0.5, 0.9, 0.99})
    for (const double c : {-1., -0.7, 0., 0.3, 0.999, 1.}) {
      const long double square = 1 + (long double)(g)*g - 2 * (long double)(g)*c;
      const long double truth =
          (1 - (long double)(g)*g) / (4 * std::acos(-1.L) * square * std::sqrt(square));
      EXPECT_NEAR(HenyeyGreenstein{g}(c) / double(truth), 1, 1e-14) << g << " " << c;
    }
}

TEST(HenyeyGreenstein, is_finite_however_sharp_its_lobe) {
  const double sharpest = std::nextafter(1., 0.);
  for (const double g : {sharpest, -sharpest, 1 - 1e-13}) {
    const double c = g > 0 ? 1 : -1;
    EXPECT_LT(HenyeyGreenstein{g}(c), 1e40) << g;
    EXPECT_LT(HenyeyGreenstein{g}(float(c)), 1e38f) << g;
  }
}

TEST(HenyeyGreenstein, has_g_as_its_mean_cosine) {
  for (const double g : {-0.99, -0.5, -1e-3, -1e-5, 0., 1e-7, 1e-4, 1e-3, 0.5, 0.9, 0.99}) {
    const HenyeyGreenstein phase{g};
    EXPECT_NEAR(integrate(-1, 1, [&](double c) { return 2 * pi * c * phase(c); }), g, 1e-11);
    // Also of its samples: the mean over u.
    EXPECT_NEAR(integrate(0, 1, [&](double u) { return phase.sample(u); }), g, 1e-11) << g;
  }
}

TEST(HenyeyGreenstein, scatters_forward_where_g_is_positive) {
  EXPECT_GT(HenyeyGreenstein{0.6}(1.), 10 * HenyeyGreenstein{0.6}(-1.));
  EXPECT_GT(HenyeyGreenstein{-0.6}(-1.), 10 * HenyeyGreenstein{-0.6}(1.));
  EXPECT_NEAR(HenyeyGreenstein{0.6}(0.8), HenyeyGreenstein{-0.6}(-0.8), 1e-16);
}

TEST(Rayleigh, scatters_twice_as_much_along_as_across) {
  EXPECT_NEAR(Rayleigh{}(0.), 3 / (16 * pi), 1e-16);
  EXPECT_NEAR(Rayleigh{}(1.), 2 * Rayleigh{}(0.), 1e-16);
  EXPECT_EQ(Rayleigh{}(-0.4), Rayleigh{}(0.4));
}

TEST(Isotropic, is_one_over_the_sphere) { EXPECT_DOUBLE_EQ(Isotropic{}(0.2), 1 / (4 * pi)); }

}  // namespace
}  // namespace airlight
