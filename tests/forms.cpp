// What every form makes of its sums, and when a quotient may be formed.

#include <airlight/forms.h>
#include <airlight/math/special.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/stats.h"
#include "support/typed.h"

namespace airlight {
namespace {

using Colour = Rgb<double>;

template <class M>
class EveryForm : public ::testing::Test {};

TYPED_TEST_SUITE(EveryForm, test::MembersOf<Forms>::Types, test::MemberName);

void expect_near(const Colour& found, const Colour& wanted) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 1e-15 * (1 + wanted[c])) << c;
}

TYPED_TEST(EveryForm, gives_the_lit_part_of_exact_sums) {
  // As samples grow in number U becomes A and O what is lit of it.
  const Colour all{3, 2, 0.5}, lit{1, 2, 0.2};
  expect_near(TypeParam{}(all, lit, all).radiance(), lit);
}

TYPED_TEST(EveryForm, is_black_in_the_dark) {
  const Colour black;
  expect_near(TypeParam{}(black, black, black).radiance(), black);
  // All in the shadow: black again, as far as the samples tell.
  const Colour all{3, 2, 1};
  expect_near(TypeParam{}(all, black, all).radiance(), black);
}

TYPED_TEST(EveryForm, scales_with_the_light) {
  const Colour all{3, 2, 0.5}, occluded{1, 1.5, 0.2}, unoccluded{2.5, 2.2, 0.6};
  const Colour once = TypeParam{}(all, occluded, unoccluded).radiance();
  expect_near(TypeParam{}(all * 8., occluded * 8., unoccluded * 8.).radiance(), once * 8.);
}

TYPED_TEST(EveryForm, says_the_same_in_every_arithmetic) {
  const Colour all{3, 2, 0}, occluded{1, 1.5, 0}, unoccluded{2.5, 2.2, 0};
  const Colour wide = TypeParam{}(all, occluded, unoccluded).radiance();
  const auto narrow =
      TypeParam{}(Rgb<float>(all), Rgb<float>(occluded), Rgb<float>(unoccluded)).radiance();
  const auto lanes =
      TypeParam{}(Rgb<FloatBatch>(all), Rgb<FloatBatch>(occluded), Rgb<FloatBatch>(unoccluded))
          .radiance();
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(narrow[c], wide[c], 1e-6);
    EXPECT_NEAR(lane(lanes[c], 0), wide[c], 1e-6);
  }
}

TEST(MonteCarlo, keeps_the_noise_of_its_samples) {
  expect_near(MonteCarlo{}(Colour(3), Colour(2.7), Colour(2.7)).radiance(), Colour(2.7));
}

TEST(Ratio, has_no_noise_where_visibility_is_constant) {
  expect_near(Ratio{}(Colour(3), Colour(2.7), Colour(2.7)).radiance(), Colour(3));
  expect_near(Ratio{}(Colour(3), Colour(2.7 / 4), Colour(2.7)).radiance(), Colour(3. / 4));
}

TEST(Difference, has_no_noise_where_everything_is_lit) {
  expect_near(Difference{}(Colour(3), Colour(2.7), Colour(2.7)).radiance(), Colour(3));
  expect_near(Difference{}(Colour(3), Colour(2), Colour(2.7)).radiance(), Colour(2.3));
}

TEST(Estimate, adds_sums_before_it_divides) {
  Estimate<double> sums = Ratio{}(Colour(1), Colour(1), Colour(2));
  sums += Ratio{}(Colour(3), Colour(3), Colour(4));
  sums += MonteCarlo{}(Colour(9), Colour(0.25), Colour(9));
  // 0.25 + (1 + 3) (1 + 3) / (2 + 4); the quotients alone would give 0.5 + 2.25.
  expect_near(sums.radiance(), Colour(0.25 + 16. / 6));
  expect_near((sums * 0.5).radiance(), Colour(0.5 * (0.25 + 16. / 6)));
}

TEST(Estimate, takes_nothing_over_nothing_for_nothing) {
  const Estimate<double> sums = Ratio{}(Colour(1), Colour(0), Colour(0));
  expect_near(sums.radiance(), Colour(0));
}

/// March of n jittered steps over [0, 1] with transmittance e^{−3 t}, dark from 0.5 on.
template <class Form>
Estimate<double> march(int n, std::mt19937_64& generator) {
  double occluded = 0, unoccluded = 0;
  for (int i = 0; i < n; ++i) {
    const double t = (i + std::ldexp(double(generator() >> 11), -53)) / n;
    const double weight = std::exp(-3 * t) / n;
    unoccluded += weight;
    if (t < 0.5) occluded += weight;
  }
  return Form{}(Colour(phi(3.)), Colour(occluded), Colour(unoccluded));
}
const double lit_half = (1 - std::exp(-1.5)) / 3;

TEST(Ratio, is_biased_unless_its_sums_are_pooled) {
  // An odd number of steps, so that one of them straddles the edge of the shadow. A quotient a
  // pixel, averaged, is off by what no number of pixels mends; one quotient of all sums is not.
  std::mt19937_64 generator(1);
  std::vector<double> quotients, pooled, plain, difference;
  for (int seed = 0; seed < 200; ++seed) {
    Estimate<double> sums;
    double mean_quotient = 0, mean_plain = 0, mean_difference = 0;
    const int pixels = 2000;
    for (int pixel = 0; pixel < pixels; ++pixel) {
      const Estimate<double> one = march<Ratio>(3, generator);
      sums += one;
      mean_quotient += one.radiance().r / pixels;
      mean_plain += march<MonteCarlo>(3, generator).radiance().r / pixels;
      mean_difference += march<Difference>(3, generator).radiance().r / pixels;
    }
    quotients.push_back(mean_quotient);
    pooled.push_back((sums * (1. / pixels)).radiance().r);
    plain.push_back(mean_plain);
    difference.push_back(mean_difference);
  }
  EXPECT_GT(std::abs(test::z_score(quotients, lit_half)), 20);
  EXPECT_LT(std::abs(test::z_score(pooled, lit_half)), 4);
  EXPECT_LT(std::abs(test::z_score(plain, lit_half)), 4);
  EXPECT_LT(std::abs(test::z_score(difference, lit_half)), 4);
  EXPECT_LT(test::relative_standard_error(pooled), 5e-4);
  EXPECT_LT(test::relative_standard_error(plain), 5e-4);
  EXPECT_LT(test::relative_standard_error(difference), 5e-4);
}

}  // namespace
}  // namespace airlight
