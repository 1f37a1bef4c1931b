#pragma once
#include <array>
#include <utility>

#include "simd.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Names the exchanges that sort n numbers, exchange(i, j) with i < j: Batcher's merge exchange,
/// whose comparisons do not depend on the numbers (Knuth, The Art of Computer Programming 5.2.2,
/// algorithm M).
template <class Exchange>
constexpr void merge_exchange(int n, Exchange&& exchange) {
  for (int p = 1; p < n; p *= 2)
    for (int k = p; k > 0; k /= 2)
      for (int j = k & (p - 1); j + k < n; j += 2 * k)
        for (int i = j; i < j + k && i + k < n; ++i)
          if ((i ^ (i + k)) < 2 * p) exchange(i, i + k);  // both in one block of 2 p
}

/// Sorts n numbers upwards, lane by lane.
template <class T>
void sort_lanes(T* x, int n) noexcept {
  merge_exchange(n, [x](int i, int j) {
    const T low = min(x[i], x[j]), high = max(x[i], x[j]);
    x[i] = low, x[j] = high;
  });
}

/// The same with the exchanges written out, so that the numbers stay in registers.
template <int n, class T>
void sort_lanes(T* x) noexcept {
  static constexpr auto exchanges = [] {
    constexpr int count = [] {
      int counted = 0;
      merge_exchange(n, [&](int, int) { ++counted; });
      return counted;
    }();
    std::array<std::pair<int, int>, std::size_t(count)> all;
    std::size_t next = 0;
    merge_exchange(n, [&](int i, int j) { all[next++] = {i, j}; });
    return all;
  }();
  T sorted[n];
  for (int i = 0; i < n; ++i) sorted[i] = x[i];
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto exchange = [&](T& a, T& b) {
      const T low = min(a, b), high = max(a, b);
      a = low, b = high;
    };
    (exchange(sorted[exchanges[k].first], sorted[exchanges[k].second]), ...);
  }
  (std::make_index_sequence<exchanges.size()>());
  for (int i = 0; i < n; ++i) x[i] = sorted[i];
}

}  // namespace airlight::inline AIRLIGHT_ISA
