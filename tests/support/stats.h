#pragma once
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "quadrature.h"
#include "report/statistics.h"

namespace airlight::test {

/// How many standard errors the mean of `values`, each from a seed of its own, lies off the truth.
///
/// `rounding` is the absolute error that arithmetic alone may cause; the standard error is taken to
/// be no smaller, so that an estimator without noise is held to rounding and not to nothing. NaN
/// among the values gives NaN, which no `EXPECT_LT` lets pass.
inline double z_score(std::span<const double> values, double truth, double rounding = 0) {
  const double off = mean(values) - truth;
  const double error = standard_error(values);
  const double unit = error > rounding || std::isnan(error) ? error : rounding;
  return off == 0 ? 0 : off / unit;
}

/// Standard error over the mean: what a z-test can see at all. The papers' checks ask for 5e-4.
inline double relative_standard_error(std::span<const double> values) {
  return standard_error(values) / std::abs(mean(values));
}

/// Pearson's chi-squared p of n draws `sample(u)`, u uniform in [0, 1), against the density `pdf`.
///
/// The density is integrated over each of `bins` equal parts of [lo, hi] by quadrature; `breaks`
/// are the places where it jumps or bends. Zero if a draw is NaN or outside [lo, hi], or if the
/// density does not integrate to one (within a tenth of what n draws can tell).
template <class Sample, class Pdf>
double chi_squared_p(int bins, int n, Sample&& sample, Pdf&& pdf, double lo = -1, double hi = 1,
                     const std::vector<double>& breaks = {}, unsigned seed = 1) {
  std::mt19937_64 generator(seed);
  std::vector<double> draws;
  draws.reserve(std::size_t(n));
  for (int i = 0; i < n; ++i) draws.push_back(sample(std::ldexp(double(generator() >> 11), -53)));
  const Histogram h = histogram(draws, bins, lo, hi);
  if (h.outside > 0) return 0;

  std::vector<double> expected;
  double mass = 0;
  for (int i = 0; i < bins; ++i) {
    const double a = lo + (hi - lo) * i / bins, b = lo + (hi - lo) * (i + 1) / bins;
    expected.push_back(integrate(a, b, pdf, 1e-9, breaks));
    mass += expected.back();
  }
  if (!(std::abs(mass - 1) <= 0.1 / std::sqrt(double(n)))) return 0;
  for (double& e : expected) e *= n / mass;
  return chi_squared(h.counts, expected).p;
}

}  // namespace airlight::test
