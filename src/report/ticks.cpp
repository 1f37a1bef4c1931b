#include "report/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/text.h"

namespace airlight {
namespace {

/// 1, 2 or 5 times a power of ten, the smallest not below x.
double round_step(double x) {
  const double decade = std::pow(10., std::floor(std::log10(x)));
  for (const double m : {1., 2., 5.})
    if (m * decade >= x * (1 - 1e-9)) return m * decade;
  return 10 * decade;
}

std::vector<Tick> linear_ticks(double low, double high, int wanted) {
  const double step = round_step((high - low) / wanted);
  const double largest = std::max(std::abs(low), std::abs(high));
  const int places = -int(std::floor(std::log10(step) + 1e-9));
  const bool plain = largest < 1e6 && places <= 5;
  std::vector<Tick> out;
  const double slack = 1e-9 * (high - low);  // ends that are round must not be lost to rounding
  for (double i = std::ceil((low - slack) / step); i * step <= high + slack; ++i) {
    const double at = i * step;
    if (i == 0)
      out.push_back({0, "0"});
    else if (plain)
      out.push_back(
          {at, fmt::format("{}{:.{}f}", at < 0 ? "−" : "", std::abs(at), std::max(0, places))});
    else
      out.push_back(
          {at, number(at, 1 + std::max(0, int(std::floor(std::log10(std::abs(at)))) + places))});
  }
  return out;
}

/// Ticks at base^k, every `stride`-th with a label.
std::vector<Tick> log2_ticks(double low, double high, int wanted) {
  const int first = int(std::ceil(std::log2(low) - 1e-9)),
            last = int(std::floor(std::log2(high) + 1e-9));
  const int stride = std::max(1, int(std::ceil((last - first + 1) / (1.5 * wanted))));
  std::vector<Tick> out;
  for (int k = first; k <= last; ++k)
    out.push_back({std::exp2(k), k % stride == 0 ? number(std::exp2(k), 3) : ""});
  return out;
}

/// Ticks at 1 to 9 times the powers of ten; which of them carry a label depends on how many there
/// are.
std::vector<Tick> log_ticks(double low, double high, int wanted) {
  const int first = int(std::floor(std::log10(low))), last = int(std::ceil(std::log10(high)));
  const auto inside = [&](double at) { return at >= low * (1 - 1e-9) && at <= high * (1 + 1e-9); };
  int decades = 0, halves = 0;
  for (int k = first; k <= last; ++k)
    for (const int m : {1, 2, 5})
      if (inside(m * std::pow(10., k))) {
        ++halves;
        decades += m == 1;
      }
  const int stride = std::max(1, (decades + wanted) / (wanted + 1));
  const auto labelled = [&](int m, int k) {
    if (decades >= 3 || (decades == 2 && halves > wanted + 2)) return m == 1 && k % stride == 0;
    return halves < 3 || m == 1 || m == 2 || m == 5;
  };
  const bool plain = first >= -4 && last <= 5;
  std::vector<Tick> out;
  for (int k = first; k <= last; ++k)
    for (int m = 1; m < 10; ++m) {
      const double at = m * std::pow(10., k);
      if (!inside(at) || (stride > 1 && m > 1)) continue;
      std::string label;
      if (labelled(m, k))
        label = plain ? number(at, 1)
                      : (m == 1 ? "" : std::to_string(m) + " × ") + "10" + superscript(k);
      out.push_back({at, label});
    }
  return out;
}

}  // namespace

std::vector<Tick> ticks(Scale scale, double low, double high, int wanted) {
  std::vector<Tick> out;
  if (scale == Scale::log2) out = log2_ticks(low, high, wanted);
  if (scale == Scale::log) out = log_ticks(low, high, wanted);
  // Within a few per cent a log axis is as good as straight.
  const auto labels =
      std::count_if(out.begin(), out.end(), [](const Tick& t) { return !t.label.empty(); });
  return labels >= 2 ? out : linear_ticks(low, high, wanted);
}

}  // namespace airlight
