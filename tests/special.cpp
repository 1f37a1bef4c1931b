// The special functions in every arithmetic against long double.

#include "airlight/math/special.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "airlight/math/sort.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using Exact = long double;
using test::Worst;

Exact exact_phi(Exact y) { return y == 0 ? 1 : -std::expm1(-y) / y; }
Exact exact_one_minus_exp(Exact y) { return -std::expm1(-y); }
/// g of: the part of ∫ e^{−y x} dx over [0, 1] that lies below g is v.
Exact exact_fraction(Exact y, Exact v) {
  if (y == 0) return v;
  return std::min<Exact>(-std::log1p(v * std::expm1(-y)) / y, 1);
}

template <class F>
class EveryArithmetic : public ::testing::Test {};
TYPED_TEST_SUITE(EveryArithmetic, test::Arithmetics, test::ArithmeticName);

/// How many units of 1e-16 or 1e-7 a bound may be.
template <Real F>
double bound(double in_double, double in_float) {
  return std::same_as<F, double> ? in_double : in_float;
}

/// Numbers of F in [low, high], even over the orders of magnitude, with what is special.
template <Real F>
std::vector<Scalar<F>> spread(double low, double high, int n) {
  std::vector<Scalar<F>> numbers = {0};
  for (int i = 0; i < n; ++i)
    numbers.push_back(Scalar<F>(low * std::pow(high / low, i / (n - 1.))));
  for (const double x : {1e-38, 1e-30, 1e-20, 0.5, 1 - 0x1p-24, 1., 1 + 0x1p-23})
    if (x <= high) numbers.push_back(Scalar<F>(x));
  return numbers;
}

/// f over all the numbers, lane by lane.
template <Real F, class Function, class See>
void walk(const std::vector<Scalar<F>>& numbers, Function&& f, See&& see) {
  for (std::size_t i = 0; i < numbers.size(); i += lanes<F>) {
    Scalar<F> in[lanes<F>];
    for (int k = 0; k < lanes<F>; ++k)
      in[k] = numbers[std::min(i + std::size_t(k), numbers.size() - 1)];
    const F out = f(load<F>(in));
    for (int k = 0; k < lanes<F>; ++k) see(in[k], lane(out, k));
  }
}

double relative(Exact found, Exact truth) {
  return found == truth ? 0 : double(std::abs(found / truth - 1));
}

TYPED_TEST(EveryArithmetic, knows_phi) {
  using F = TypeParam;
  Worst below("phi below one, relative error"), everywhere("phi, relative error");
  walk<F>(
      spread<F>(1e-12, 1, 200'000), [](F y) { return phi_below_one(y); },
      [&](Exact y, Exact found) { below.see(relative(found, exact_phi(y)), y); });
  walk<F>(
      spread<F>(1e-12, 2e4, 400'000), [](F y) { return phi(y); },
      [&](Exact y, Exact found) { everywhere.see(relative(found, exact_phi(y)), y); });
  below.expect_below(bound<F>(5e-16, 2e-7));
  everywhere.expect_below(bound<F>(5e-16, 2e-7));
}

TYPED_TEST(EveryArithmetic, knows_one_minus_exp) {
  using F = TypeParam;
  Worst worst("1 - exp(-y), relative error");
  walk<F>(
      spread<F>(1e-12, 200, 400'000), [](F y) { return one_minus_exp(y); },
      [&](Exact y, Exact found) { worst.see(relative(found, exact_one_minus_exp(y)), y); });
  worst.expect_below(bound<F>(5e-16, 3e-7));
}

TYPED_TEST(EveryArithmetic, knows_log1p_minus) {
  using F = TypeParam;
  Worst worst("log(1 - z), relative error");
  std::vector<Scalar<F>> numbers = spread<F>(1e-12, 0.999, 400'000);
  for (int i = 1; i < 100'000; ++i) numbers.push_back(Scalar<F>(i) / Scalar<F>(100'000));
  walk<F>(
      numbers, [](F z) { return log1p_minus(z); },
      [&](Exact z, Exact found) {
        if (z < 1) worst.see(relative(found, std::log1p(-z)), z);
      });
  worst.expect_below(bound<F>(5e-16, 3e-7));
  const double last = lane(log1p_minus(F(1)), 0);
  EXPECT_TRUE(std::isfinite(last) && last < -16) << last;
}

TYPED_TEST(EveryArithmetic, splits_an_exponential) {
  // Judged by how far v would have to move to give the answer exactly, or by the answer's own
  // rounding, whichever is kinder.
  using F = TypeParam;
  const double eps = double(std::numeric_limits<Scalar<F>>::epsilon());
  Worst worst("part of an exponential, off v by");
  for (const Scalar<F> y : spread<F>(1e-9, 1e5, 300)) {
    std::vector<Scalar<F>> parts = spread<F>(1e-9, 1, 300);
    parts.push_back(1 - Scalar<F>(eps) / 2);
    for (int i = 1; i < 300; ++i) parts.push_back(Scalar<F>(i) / Scalar<F>(300));
    walk<F>(
        parts, [&](F v) { return exponential_fraction(F(y), v); },
        [&](Exact v, Exact g) {
          ASSERT_TRUE(g >= 0 && g <= 1) << "y " << y << " v " << v;
          const Exact back = y == 0 ? g : std::expm1(-Exact(y) * g) / std::expm1(-Exact(y));
          const Exact own = std::abs(g / std::max<Exact>(exact_fraction(y, v), 1e-30L) - 1);
          worst.see(own < 2 * eps ? 0 : double(std::abs(back - v)), y);
        });
  }
  worst.expect_below(bound<F>(1e-15, 5e-7));
}

TYPED_TEST(EveryArithmetic, splits_an_exponential_in_order) {
  using F = TypeParam;
  const double eps = double(std::numeric_limits<Scalar<F>>::epsilon());
  for (const double y : {0., 1e-9, 1e-6, 0.99e-5, 1.01e-5, 1e-3, 1.99e-3, 2.01e-3, 0.1, 1., 1e2}) {
    std::vector<Scalar<F>> parts;
    for (int i = 0; i <= 4096; ++i) parts.push_back(Scalar<F>(i) / Scalar<F>(4096));
    Exact before = 0;
    walk<F>(
        parts, [&](F v) { return exponential_fraction(F(Scalar<F>(y)), v); },
        [&](Exact v, Exact g) {
          EXPECT_GE(g * (1 + 4 * eps), before) << "y " << y << " v " << v;
          before = g;
        });
    EXPECT_EQ(lane(exponential_fraction(F(Scalar<F>(y)), F(0)), 0), 0) << y;
    EXPECT_NEAR(lane(exponential_fraction(F(Scalar<F>(y)), F(1)), 0), y < 10 ? 1 : 0.5,
                y < 10 ? 1e-3 : 0.5);
  }
}

TYPED_TEST(EveryArithmetic, sorts_every_lane) {
  using F = TypeParam;
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    constexpr int most = 16;
    const int n = 1 + round % most;
    std::uint32_t drawn[most][lanes<F>];
    for (auto& row : drawn)
      for (std::uint32_t& x : row) x = round % 3 == 0 ? random() : random() % 4 << 30;
    UInt<F> some[most], all[most];
    for (int i = 0; i < most; ++i) some[i] = all[i] = load_bits<F>(drawn[i]);
    sort_lanes(some, n);
    sort_lanes<most>(all);
    for (int k = 0; k < lanes<F>; ++k) {
      const auto expect_sorted = [&](const UInt<F>* x, int count) {
        std::vector<std::uint32_t> wanted, found;
        for (int i = 0; i < count; ++i) {
          wanted.push_back(drawn[i][k]);
          if constexpr (lanes<F> == 1)
            found.push_back(x[i]);
          else
            found.push_back(x[i].get(std::size_t(k)));
        }
        std::ranges::sort(wanted);
        EXPECT_EQ(found, wanted);
      };
      expect_sorted(some, n), expect_sorted(all, most);
    }
  }
}

}  // namespace
}  // namespace airlight
