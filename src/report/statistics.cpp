#include "report/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.h"

namespace airlight {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// x^a e^−x / Γ(a + 1), without the cancellation that exp(a ln x − x − lnΓ) suffers for large a.
double gamma_density(double a, double x) {
  if (x == 0) return 0;
  if (a < 20) return std::exp(a * std::log(x) - x) / std::tgamma(a + 1);
  // Stirling: Γ(a + 1) = √(2πa) a^a e^−a e^s; the first term left out is below 1e-13 at a = 20.
  const double b = 1 / (a * a);
  const double s = (1 / 12. - b * (1 / 360. - b * (1 / 1260. - b * (1 / 1680. - b / 1188)))) / a;
  const double d = (x - a) / a;
  return std::exp(-a * (d - std::log1p(d)) - s) / std::sqrt(2 * std::numbers::pi * a);
}

/// P(a, x) by its power series; converges fast for x < a + 1.  Abramowitz and Stegun 6.5.29.
double lower_gamma_series(double a, double x) {
  double term = 1, sum = 1;
  for (double n = 1; term > sum * 1e-17; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return gamma_density(a, x) * sum;
}

/// Q(a, x) by its continued fraction, evaluated forwards (Lentz); converges fast for x > a + 1.
/// Abramowitz and Stegun 6.5.31.
double upper_gamma_fraction(double a, double x) {
  constexpr double tiny = 1e-300;  // stands in for a denominator of zero
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (double i = 1; i < 1e6; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return gamma_density(a, x) * a * h;
}

}  // namespace

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? nan : sum / double(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return nan;
  const double m = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - m) * (v - m);
  return std::sqrt(sum / double(values.size() - 1));
}

double standard_error(std::span<const double> values) {
  return standard_deviation(values) / std::sqrt(double(values.size()));
}

Spread spread(std::span<const double> values) {
  if (values.empty()) return {0, nan, nan, nan, nan, nan};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {values.size(),          mean(values), standard_deviation(values),
          standard_error(values), *low,         *high};
}

double upper_gamma(double a, double x) {
  if (!(a > 0) || !(x >= 0)) return nan;
  if (std::isinf(x)) return 0;
  return x < a + 1 ? 1 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
}

double chi_squared_p(double statistic, double degrees) {
  return degrees > 0 ? upper_gamma(degrees / 2, statistic / 2) : 1;
}

double normal_two_sided_p(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double kolmogorov_smirnov_distance(std::span<const double> samples,
                                   const std::function<double(double)>& cdf) {
  std::vector<double> sorted(samples.begin(), samples.end());
  if (std::any_of(sorted.begin(), sorted.end(), [](double v) { return std::isnan(v); })) return nan;
  std::sort(sorted.begin(), sorted.end());
  const double n = double(sorted.size());
  double distance = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double c = cdf(sorted[i]);
    distance = std::max({distance, c - double(i) / n, double(i + 1) / n - c});
  }
  return distance;
}

double kolmogorov_smirnov_p(double distance, std::size_t n) {
  const double root = std::sqrt(double(n));
  if (std::isnan(distance)) return nan;
  if (distance <= 0.5 / double(n)) return 1;  // no set of n samples comes closer than 1/(2n)
  if (distance >= 1) return 0;
  const double x = root * distance + 1 / (6 * root) + (root * distance - 1) / (4 * double(n));
  if (x < 0.2) return 1;  // to 5e-13, by the dual of the series below
  double sum = 0;
  for (int k = 1; k < 20; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2 * k * k * x * x);
  return std::clamp(sum, 0., 1.);
}

ChiSquared chi_squared(std::span<const double> observed, std::span<const double> expected,
                       double least) {
  if (observed.size() != expected.size())
    throw Error("chi-squared: " + std::to_string(observed.size()) + " observed counts and " +
                std::to_string(expected.size()) + " expected ones; they must be as many");
  constexpr ChiSquared wrong = {std::numeric_limits<double>::infinity(), 0, 0};
  struct Bin {
    double observed = 0, expected = 0;
  };
  std::vector<Bin> merged(1);
  Bin all;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (observed[i] > 0 && !(expected[i] > 0)) return wrong;
    if (merged.back().expected >= least) merged.emplace_back();
    merged.back().observed += observed[i];
    merged.back().expected += expected[i];
    all.observed += observed[i];
    all.expected += expected[i];
  }
  if (!(std::abs(all.observed - all.expected) <= 1e-6 * all.observed)) return wrong;
  if (merged.size() > 1 && merged.back().expected < least) {  // the last one joins its neighbour
    merged[merged.size() - 2].observed += merged.back().observed;
    merged[merged.size() - 2].expected += merged.back().expected;
    merged.pop_back();
  }
  ChiSquared result;
  result.degrees = int(merged.size()) - 1;
  for (const Bin& bin : merged)
    if (bin.expected > 0) {
      const double d = bin.observed - bin.expected;
      result.statistic += d * d / bin.expected;
    }
  result.p = chi_squared_p(result.statistic, result.degrees);
  return result;
}

Histogram histogram(std::span<const double> values, int bins, double low, double high) {
  Histogram h;
  h.counts.resize(std::size_t(std::max(bins, 1)));
  for (const double v : values) {
    if (!(v >= low && v <= high)) {
      ++h.outside;
      continue;
    }
    const auto bin = std::size_t((v - low) / (high - low) * double(h.counts.size()));
    ++h.counts[std::min(bin, h.counts.size() - 1)];
  }
  return h;
}

}  // namespace airlight
