#pragma once
#include <benchmark/benchmark.h>

#include <chrono>
#include <functional>
#include <vector>

/// Measuring on machines that are shared and noisy: medians of many, and ratios of runs that took
/// place side by side.
namespace airlight::bench {

/// Makes the compiler believe that a result is used, and that memory was read.
template <class T>
void keep(T& value) {
  benchmark::DoNotOptimize(value);
  benchmark::ClobberMemory();
}

/// Wall-clock seconds that `work` takes.
template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The middle of the values, or the mean of the two in the middle; NaN of none.
double median(std::vector<double> values);

/// Median of the seconds of `repeats` runs (>= 1), after one that is not counted and warms caches
/// and clocks.
double median_seconds(int repeats, const std::function<void()>& work);

/// Seconds after which runs of growing length reach a quality, in a unit whose growth goes with the
/// logarithm of time (decibels): on the line between the runs on either side. NaN if none reaches
/// it or the first does already. Both vectors have a value for each run.
double seconds_to(double wanted, const std::vector<double>& quality,
                  const std::vector<double>& seconds);

/// Seconds of `a` over seconds of `b`: the median over `pairs` (>= 1) of the ratio of two
/// neighbouring runs, so that what slows the machine for a while slows both. Every other pair runs
/// `b` first; one pair is run before and not counted.
double median_ratio(int pairs, const std::function<void()>& a, const std::function<void()>& b);

/// Keeps the calling thread on one of the processors that it may run on, until destroyed. Where the
/// system refuses, the thread stays free and `pinned` says so.
class Pin {
 public:
  /// The nth (from 0, counted round) of the processors allowed to the thread.
  explicit Pin(int nth = 0);
  ~Pin();
  Pin(const Pin&) = delete;
  Pin& operator=(const Pin&) = delete;
  bool pinned() const { return pinned_; }

 private:
  std::vector<int> allowed_;
  bool pinned_ = false;
};

}  // namespace airlight::bench
