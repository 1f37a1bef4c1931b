#pragma once
#include "simd.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Sorts n numbers upwards, lane by lane: Batcher's merge exchange, whose comparisons do not depend
/// on the numbers (Knuth, The Art of Computer Programming 5.2.2, algorithm M).
template <Real F>
void sort_lanes(F* x, int n) noexcept {
  for (int p = 1; p < n; p *= 2)
    for (int k = p; k > 0; k /= 2)
      for (int j = k % p; j + k < n; j += 2 * k)
        for (int i = j; i < j + k && i + k < n; ++i)
          if (i / (2 * p) == (i + k) / (2 * p)) {
            const F low = min(x[i], x[i + k]), high = max(x[i], x[i + k]);
            x[i] = low, x[i + k] = high;
          }
}

}  // namespace airlight::inline AIRLIGHT_ISA
