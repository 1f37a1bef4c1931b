#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace airlight {

/// Arithmetic mean; NaN of nothing.
double mean(std::span<const double> values);

/// Standard deviation of the population the values were drawn from (divisor n − 1); NaN below two.
double standard_deviation(std::span<const double> values);

/// Standard error of the mean: standard deviation / √n; NaN below two values.
double standard_error(std::span<const double> values);

/// What one number does over independent seeds.
struct Spread {
  std::size_t count = 0;
  double mean = 0;
  double standard_deviation = 0;  ///< divisor n − 1; NaN below two values
  double standard_error = 0;      ///< of the mean; NaN below two values
  double low = 0;                 ///< smallest value
  double high = 0;                ///< largest value
};
Spread spread(std::span<const double> values);

/// The regularised incomplete gamma function above x, Q(a, x) = Γ(a, x) / Γ(a), for a > 0 and x ≥
/// 0. Relative error below 1e-10 wherever Q > 1e-290 and a ≤ 1e6. NaN outside its domain.
double upper_gamma(double a, double x);

/// The probability that a chi-squared variate with `degrees` of freedom exceeds `statistic`.
/// 1 where nothing is free (degrees ≤ 0): no evidence against anything.
double chi_squared_p(double statistic, double degrees);

/// The probability that a standard normal variate is farther from zero than z.
double normal_two_sided_p(double z);

/// The largest distance between the empirical distribution function of `samples` (in any order) and
/// `cdf`. NaN among the samples gives NaN; no samples give 0.
double kolmogorov_smirnov_distance(std::span<const double> samples,
                                   const std::function<double(double)>& cdf);

/// The probability that n samples of the right distribution lie at least `distance` away from it.
/// Kolmogorov's limit with the correction of Vrbik 2018 for finite n; see tests/statistics.cpp for
/// its error.
double kolmogorov_smirnov_p(double distance, std::size_t n);

/// Counts beside what a model expects of them.
struct ChiSquared {
  double statistic = 0;  ///< Σ (observed − expected)² / expected over the merged bins
  int degrees = 0;       ///< merged bins − 1
  double p = 1;          ///< probability of a statistic this large or larger, if the model is right
};

/// Pearson's test of a histogram. Neighbouring bins are merged until each expects at least `least`
/// counts (below about 5 the statistic is not chi-squared distributed). Counts where nothing at all
/// is expected, and sums of counts that differ by more than rounding, give p = 0: the model is
/// wrong. Throws Error if the two differ in length.
ChiSquared chi_squared(std::span<const double> observed, std::span<const double> expected,
                       double least = 5);

/// How many values fall into each of `bins` equal parts of [low, high]; high itself belongs to the
/// last.
struct Histogram {
  std::vector<double> counts;
  double outside = 0;  ///< values below low, above high or NaN
};
Histogram histogram(std::span<const double> values, int bins, double low, double high);

}  // namespace airlight
