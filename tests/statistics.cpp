// The judges judged: p-values against values computed with 60 digits, the quadrature against
// integrals known in closed form, and both tests of distributions against samples that are right
// and samples that are not.
#include "report/statistics.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <random>

#include "error.h"
#include "support/quadrature.h"
#include "support/stats.h"

namespace airlight {
namespace {

using std::numbers::pi;
using test::integrate;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Statistics, describe_a_handful_of_numbers) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};  // mean 5, squares off it sum to 32
  EXPECT_DOUBLE_EQ(mean(values), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(32. / 7));
  EXPECT_DOUBLE_EQ(standard_error(values), std::sqrt(32. / 7 / 8));
  const Spread s = spread(values);
  EXPECT_EQ(s.count, 8u);
  EXPECT_EQ(s.low, 2);
  EXPECT_EQ(s.high, 9);
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.standard_deviation, standard_deviation(values));
  EXPECT_DOUBLE_EQ(s.standard_error, standard_error(values));
}

TEST(Statistics, do_not_pretend_to_know_the_spread_of_one_value) {
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(spread({}).mean));
  const std::vector<double> one = {3};
  EXPECT_EQ(mean(one), 3);
  EXPECT_TRUE(std::isnan(standard_deviation(one)));
  EXPECT_TRUE(std::isnan(standard_error(one)));
}

TEST(Statistics, know_the_incomplete_gamma_function) {
  struct Known {
    double a, x, q;
  };
  const Known table[] = {{0.001, 0.5, 0.00056006665647074989},
                         {0.5, 0.001, 0.96432940827032011},
                         {0.5, 0.5, 0.3173105078629141},
                         {0.5, 50, 1.5239706048321052e-23},
                         {1, 2, 0.13533528323661269},
                         {2.5, 1, 0.84914503608460964},
                         {5, 5, 0.44049328506521241},
                         {5, 20, 1.6944743930067384e-5},
                         {19.5, 30, 0.016922148663836035},
                         {25, 10, 0.9999530506185732},
                         {30, 700, 3.7455417501517598e-253},
                         {127.5, 60, 0.99999999999997516},
                         {127.5, 127.5, 0.48822252177040634},
                         {127.5, 200, 1.6600025244124518e-8},
                         {5000, 5300, 1.5545115785517565e-5},
                         {32767.5, 33000, 0.099707849240150684},
                         {500000, 502000, 0.0023630282386838922}};
  for (const auto [a, x, q] : table)
    EXPECT_NEAR(upper_gamma(a, x) / q, 1, 1e-10) << "Q(" << a << ", " << x << ")";
  EXPECT_EQ(upper_gamma(3, 0), 1);
  EXPECT_EQ(upper_gamma(3, std::numeric_limits<double>::infinity()), 0);
  EXPECT_TRUE(std::isnan(upper_gamma(0, 1)));
  EXPECT_TRUE(std::isnan(upper_gamma(1, -1)));
  EXPECT_TRUE(std::isnan(upper_gamma(1, nan)));
}

TEST(Statistics, know_the_chi_squared_and_normal_tables) {
  EXPECT_NEAR(chi_squared_p(3.841458820694124, 1), 0.05, 1e-12);
  EXPECT_NEAR(chi_squared_p(16.918977604620448, 9), 0.05, 1e-12);
  EXPECT_NEAR(chi_squared_p(310.45738821990363, 255), 0.01, 1e-12);
  EXPECT_EQ(chi_squared_p(0, 0), 1);
  EXPECT_EQ(normal_two_sided_p(0), 1);
  EXPECT_NEAR(normal_two_sided_p(1.959963984540054), 0.05, 1e-15);
  EXPECT_DOUBLE_EQ(normal_two_sided_p(-4), normal_two_sided_p(4));
  EXPECT_NEAR(normal_two_sided_p(8) / 1.2441921148543568e-15, 1, 1e-12);
}

TEST(Statistics, know_kolmogorovs_distribution) {
  struct Known {  // exact, by the matrix power of Marsaglia, Tsang and Wang 2003
    std::size_t n;
    double distance, p;
  };
  const Known table[] = {{10, 0.15811388300841897, 0.931694519567},
                         {10, 0.25298221281347033, 0.469225821724},
                         {10, 0.4300697617828996, 0.0339012742755},
                         {100, 0.05, 0.953215971064},
                         {100, 0.08, 0.518219364548},
                         {100, 0.136, 0.0448602997909},
                         {1000, 0.025298221281347035, 0.535691000328},
                         {1000, 0.06957010852370435, 0.000118383605532}};
  for (const auto [n, distance, p] :
       table)  // the correction for finite n is good to about 1 / (50 n)
    EXPECT_NEAR(kolmogorov_smirnov_p(distance, n), p, 0.02 / double(n)) << n << ", " << distance;
  EXPECT_EQ(kolmogorov_smirnov_p(0, 10), 1);
  EXPECT_NEAR(kolmogorov_smirnov_p(0.0021, 10000), 1, 1e-9);
  EXPECT_EQ(kolmogorov_smirnov_p(1, 10), 0);
}

TEST(Statistics, measure_kolmogorovs_distance) {
  const auto uniform = [](double x) { return x; };
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(std::vector{0.75, 0.25}, uniform), 0.25);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(std::vector{0.9, 0.9}, uniform), 0.9);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(std::vector{0.1, 0.1}, uniform), 0.9);
  EXPECT_TRUE(std::isnan(kolmogorov_smirnov_distance(std::vector{0.5, nan}, uniform)));
}

TEST(Histogram, counts_everything_once) {
  const Histogram h = histogram(std::vector{0., 0.1, 0.5, 1., -0.1, 1.1, nan}, 2, 0, 1);
  EXPECT_THAT(h.counts, ::testing::ElementsAre(2, 2));  // 0.5 opens the second bin, 1 closes it
  EXPECT_EQ(h.outside, 3);
}

TEST(ChiSquared, is_the_textbook_sum) {
  // 60 throws of a die: Σ (o − 10)² / 10 = (25 + 4 + 1 + 4 + 1 + 25) / 10
  const ChiSquared test =
      chi_squared(std::vector<double>{5, 8, 9, 12, 11, 15}, std::vector<double>(6, 10));
  EXPECT_DOUBLE_EQ(test.statistic, 6);
  EXPECT_EQ(test.degrees, 5);
  EXPECT_DOUBLE_EQ(test.p, chi_squared_p(6, 5));
}

TEST(ChiSquared, merges_bins_that_expect_too_little) {
  const ChiSquared test =
      chi_squared(std::vector<double>{3, 3, 10, 1, 2}, std::vector<double>{2, 3, 10, 3, 1});
  // {6 of 5}, {10 of 10, joined by the 3 of 4 that are too few to stand alone}
  EXPECT_EQ(test.degrees, 1);
  EXPECT_DOUBLE_EQ(test.statistic, 1. / 5 + 1. / 14);
}

TEST(ChiSquared, condemns_what_cannot_be) {
  EXPECT_EQ(chi_squared(std::vector<double>{10, 1}, std::vector<double>{11, 0}).p, 0);
  EXPECT_EQ(chi_squared(std::vector<double>{10, 10}, std::vector<double>{10, nan}).p, 0);
  EXPECT_EQ(chi_squared(std::vector<double>{10, 10}, std::vector<double>{20, 20}).p, 0);
  EXPECT_THROW(chi_squared(std::vector<double>{10, 10}, std::vector<double>{20}), Error);
}

TEST(Quadrature, finds_integrals_known_in_closed_form) {
  EXPECT_NEAR(integrate(0, 1, [](double x) { return std::exp(x); }), std::numbers::e - 1, 1e-15);
  EXPECT_NEAR(integrate(1, 0, [](double x) { return std::exp(x); }), 1 - std::numbers::e, 1e-15);
  EXPECT_EQ(integrate(2, 2, [](double x) { return x; }), 0);
  EXPECT_NEAR(integrate(0, pi, [](double x) { return std::sin(x); }), 2, 1e-14);
  EXPECT_NEAR(integrate(0, 1, [](double x) { return std::sqrt(x); }), 2. / 3, 1e-12);
  EXPECT_NEAR(integrate(-1, 1, [](double x) { return 1 / (1e-4 + x * x); }), 200 * std::atan(100),
              1e-9);                                                            // rel. 3e-12
  EXPECT_NEAR(integrate(-1, 1, [](double x) { return x * x * x; }), 0, 1e-15);  // cancels
  EXPECT_NEAR(integrate(0, 1, [](double x) { return x > 0.3 ? 2. : 0.; }), 1.4, 1e-11);  // a step
  EXPECT_TRUE(std::isnan(integrate(0, 1, [](double) { return nan; })));
}

TEST(Quadrature, is_exact_to_rounding_between_breaks) {
  const double c = 1 / pi;
  const auto kink = [&](double x) { return std::abs(x - c); };
  EXPECT_NEAR(integrate(0, 1, kink, 1e-12, {5, c, -1}), (c * c + (1 - c) * (1 - c)) / 2, 1e-16);
}

TEST(Quadrature, does_not_promise_more_than_it_keeps) {
  const auto check = [](double a, double b, auto&& f, double truth) {
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const test::Integral i = test::integrate_with_error(a, b, f, tolerance);
      EXPECT_LE(std::abs(i.value - truth), i.error + 1e-15) << tolerance;
      EXPECT_LE(i.error, tolerance * std::abs(truth) * 1.01) << tolerance;
    }
  };
  check(
      0, 2, [](double x) { return std::exp(-3 * x); }, (1 - std::exp(-6.)) / 3);
  check(
      -1, 1, [](double x) { return std::exp(-100 * x * x); }, std::sqrt(pi / 100) * std::erf(10.));
  check(
      0, 1, [](double x) { return std::cos(40 * x); }, std::sin(40.) / 40);
}

TEST(ZScore, counts_standard_errors) {
  const std::vector<double> values = {1, 2, 3, 4, 5};  // mean 3, standard error √(2.5 / 5)
  EXPECT_DOUBLE_EQ(test::z_score(values, 1), 2 / std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(test::relative_standard_error(values), std::sqrt(0.5) / 3);
  const std::vector<double> same(4, 2);
  EXPECT_EQ(test::z_score(same, 2), 0);
  EXPECT_TRUE(std::isinf(test::z_score(same, 2 + 1e-12)));
  EXPECT_NEAR(test::z_score(same, 2 + 1e-12, 1e-11), -0.1, 1e-3);
  EXPECT_TRUE(std::isnan(test::z_score(std::vector<double>{1, nan}, 1)));
}

const auto exponential = [](double t) { return std::exp(-t) / (1 - std::exp(-3.)); };  // on [0, 3]

TEST(SamplerTest, passes_a_right_sampler_with_every_probability) {
  std::vector<double> ps;
  for (unsigned seed = 1; seed <= 200; ++seed)
    ps.push_back(test::chi_squared_p(
        64, 20'000, [](double u) { return -std::log1p(-u * (1 - std::exp(-3.))); }, exponential, 0,
        3, {}, seed));
  // Of right samples the p-values are uniform.
  const double distance = kolmogorov_smirnov_distance(ps, [](double p) { return p; });
  EXPECT_GT(kolmogorov_smirnov_p(distance, ps.size()), 1e-3);
}

TEST(SamplerTest, catches_a_sampler_that_is_a_little_wrong) {
  const auto wrong = [](double u) { return -std::log1p(-u * (1 - std::exp(-3.))) * 0.99; };
  EXPECT_LT(test::chi_squared_p(64, 1'000'000, wrong, exponential, 0, 3), 1e-6);
  const auto uniform = [](double) { return 1 / 3.; };
  int draws = 0;  // one stray among two million
  const auto strays = [&](double u) { return ++draws == 100 ? 3.1 : u * 3; };
  EXPECT_EQ(test::chi_squared_p(64, 2'000'000, strays, uniform, 0, 3), 0);
  const auto broken = [](double u) { return u < 1e-5 ? nan : u * 3; };
  EXPECT_EQ(test::chi_squared_p(64, 1'000'000, broken, uniform, 0, 3), 0);
}

TEST(SamplerTest, asks_the_density_to_integrate_to_one) {
  const auto sample = [](double u) { return 2 * u - 1; };
  EXPECT_GT(test::chi_squared_p(16, 10'000, sample, [](double) { return 0.5; }), 1e-4);
  EXPECT_EQ(test::chi_squared_p(16, 10'000, sample, [](double) { return 0.51; }), 0);
}

}  // namespace
}  // namespace airlight
