// Sums of exponentials inverted, against their integral in long double.

#include "airlight/math/exponential_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using Exact = long double;
using test::Worst;

constexpr std::size_t channels = 3;

/// A sum in one lane, and its integral from 0 to g.
struct Sum {
  std::array<double, channels> weight, begin, end;

  Exact integral(Exact g) const {
    Exact sum = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const Exact y = (Exact(end[c]) - begin[c]) * g;
      sum += weight[c] * std::exp(-Exact(begin[c])) * g * (y == 0 ? 1 : -std::expm1(-y) / y);
    }
    return sum;
  }

  friend std::ostream& operator<<(std::ostream& out, const Sum& sum) {
    for (std::size_t c = 0; c < channels; ++c)
      out << sum.weight[c] << " from " << sum.begin[c] << " to " << sum.end[c] << "; ";
    return out;
  }
};

/// As in one coloured medium: all depths grow together, or all fall.
Sum in_one_medium(test::Random& random, const std::array<double, channels>& sigma) {
  Sum sum;
  const double from = random.uniform(0, 6), to = random.uniform(0, 6);
  for (std::size_t c = 0; c < channels; ++c) {
    sum.weight[c] = random.uniform();
    sum.begin[c] = sigma[c] * std::max(from - to, 0.);
    sum.end[c] = sigma[c] * std::max(to - from, 0.);
  }
  return sum;
}

/// As where media of other colours lie before the light: each as it will.
Sum in_several(test::Random& random) {
  Sum sum;
  for (std::size_t c = 0; c < channels; ++c) {
    sum.weight[c] = random.uniform();
    sum.begin[c] = random.uniform(0, 9);
    sum.end[c] = random.uniform(0, 9);
  }
  return sum;
}

std::vector<Sum> all_sums() {
  std::vector<Sum> sums;
  test::Random random(1);
  for (int i = 0; i < 400; ++i)
    for (const std::array<double, channels>& sigma : {std::array{0.085, 0.082, 0.078},
                                                      {0.3, 0.35, 0.5},
                                                      {.3, 1., 3.},
                                                      {.05, 1., 20.},
                                                      {1e-3, 1., 100.},
                                                      {1., 1., 1.},
                                                      {0., 0., 0.},
                                                      {0., 1., 1e-9}})
      sums.push_back(in_one_medium(random, sigma));
  for (int i = 0; i < 2000; ++i) sums.push_back(in_several(random));
  sums.push_back({{0, 0, 0}, {1, 2, 3}, {3, 2, 1}});             // nothing at all
  sums.push_back({{1, 0, 0}, {0, 2, 3}, {700, 2, 1}});           // one, beyond what floats hold
  sums.push_back({{1, 1, 1}, {0, 0, 0}, {1e18, 1e18, 1e18}});    // at once
  sums.push_back({{1, 1, 1e-6}, {0, 1e18, 1}, {1e18, 0, 0.5}});  // at both ends
  return sums;
}

template <class F>
class ExponentialSums : public ::testing::Test {};
TYPED_TEST_SUITE(ExponentialSums, test::Arithmetics, test::ArithmeticName);

TYPED_TEST(ExponentialSums, hold_the_part_below_that_was_asked_for) {
  using F = TypeParam;
  Worst worst("part below, off by");
  test::Random random(2);
  std::vector<double> parts = {0, 1e-30, 1e-9, 1e-3, 0.5, 1 - 0x1p-24, 1};
  for (int i = 0; i < 25; ++i) parts.push_back(random.uniform());
  std::ranges::sort(parts);
  for (const Sum& sum : all_sums()) {
    ExponentialSum<F, channels> here;
    for (std::size_t c = 0; c < channels; ++c) {
      here.begin[c] = F(Scalar<F>(sum.weight[c] * std::exp(-sum.begin[c])));
      here.end[c] = F(Scalar<F>(sum.weight[c] * std::exp(-sum.end[c])));
      here.drop[c] = F(Scalar<F>(sum.end[c] - sum.begin[c]));
    }
    const Exact whole = sum.integral(1);
    here.whole = F(Scalar<F>(whole));
    for (std::size_t i = 0; i < parts.size(); i += lanes<F>) {
      Scalar<F> part[lanes<F>];
      for (int k = 0; k < lanes<F>; ++k)
        part[k] = Scalar<F>(parts[std::min(i + std::size_t(k), parts.size() - 1)]);
      const F g = here.fraction(load<F>(part));
      for (int k = 0; k < lanes<F>; ++k) {
        const Scalar<F> found = lane(g, k);
        ASSERT_TRUE(found >= 0 && found <= 1) << sum << part[k] << " gives " << found;
        if (whole > 0) worst.see(double(std::abs(sum.integral(found) / whole - part[k])), sum);
      }
    }
  }
  worst.expect_below(std::same_as<F, double> ? 1e-14 : 3e-6);
}

TEST(PiecePick, finds_the_piece_and_the_part_of_it) {
  const std::array<double, 5> masses = {0, 2, 0, 1, 0};
  const auto pick = [&](double before) {
    PiecePick<double> picked(before);
    int piece = -1;
    for (int i = 0; i < 5; ++i)
      if (picked.reaches(masses[std::size_t(i)])) piece = i;
    return std::pair(piece, picked.part());
  };
  EXPECT_EQ(pick(0), std::pair(1, 0.));
  EXPECT_EQ(pick(1), std::pair(1, .5));
  EXPECT_EQ(pick(2.25), std::pair(3, .25));
  EXPECT_EQ(pick(3), std::pair(3, 1.));
  EXPECT_EQ(pick(3.5), std::pair(3, 1.));  // rounded up
}

}  // namespace
}  // namespace airlight
