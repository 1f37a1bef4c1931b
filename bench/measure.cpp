#include "measure.h"

#include <sched.h>

#include <algorithm>
#include <cmath>

namespace airlight::bench {
namespace {

bool restrict_to(const std::vector<int>& processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(processor, &set);
  return sched_setaffinity(0, sizeof set, &set) == 0;
}

std::vector<int> allowed_processors() {
  std::vector<int> allowed;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return allowed;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor)
    if (CPU_ISSET(processor, &set)) allowed.push_back(processor);
  return allowed;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double median_seconds(int repeats, const std::function<void()>& work) {
  work();
  std::vector<double> taken;
  for (int i = 0; i < repeats; ++i) taken.push_back(seconds(work));
  return median(taken);
}

double seconds_to(double wanted, const std::vector<double>& quality,
                  const std::vector<double>& seconds) {
  if (quality.empty() || quality[0] > wanted) return NAN;
  for (std::size_t i = 1; i < quality.size(); ++i)
    if (quality[i] >= wanted) {
      const double part = (wanted - quality[i - 1]) / (quality[i] - quality[i - 1]);
      return std::exp(std::lerp(std::log(seconds[i - 1]), std::log(seconds[i]), part));
    }
  return NAN;
}

double median_ratio(int pairs, const std::function<void()>& a, const std::function<void()>& b) {
  a();
  b();
  std::vector<double> ratios;
  for (int i = 0; i < pairs; ++i) {
    const bool b_first = i % 2;
    const double early = b_first ? seconds(b) : 0;
    const double of_a = seconds(a);
    const double of_b = b_first ? early : seconds(b);
    ratios.push_back(of_a / of_b);
  }
  return median(ratios);
}

Pin::Pin(int nth) : allowed_(allowed_processors()) {
  if (!allowed_.empty()) pinned_ = restrict_to({allowed_[nth % allowed_.size()]});
}

Pin::~Pin() {
  if (pinned_) restrict_to(allowed_);
}

}  // namespace airlight::bench
