#pragma once
#include "math/vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What every estimator returns: four sums, so that rays in a pixel, passes, lights and merged
/// renders can be added before anything is divided,
///
///     radiance = plain + analytic · occluded / unoccluded    [W/(m² sr)]
///
/// Estimators without a quotient use `plain` alone.
template <class F>
struct Estimate {
  Rgb<F> plain;       ///< added as it is
  Rgb<F> analytic;    ///< closed-form radiance without shadows
  Rgb<F> occluded;    ///< the sampled radiance with shadows
  Rgb<F> unoccluded;  ///< the same samples without shadows

  Estimate& operator+=(const Estimate& other) noexcept {
    plain += other.plain, analytic += other.analytic;
    occluded += other.occluded, unoccluded += other.unoccluded;
    return *this;
  }
  friend Estimate operator*(const Estimate& e, F s) noexcept {
    return {e.plain * s, e.analytic * s, e.occluded * s, e.unoccluded * s};
  }

  /// 0/0 counts as 0: the denominator vanishes only where every weight underflows.
  Rgb<F> radiance() const noexcept {
    const auto channel = [](F p, F a, F o, F u) {
      return p + a * select(u > F(0), o / select(u > F(0), u, F(1)), F(0));
    };
    return {channel(plain.r, analytic.r, occluded.r, unoccluded.r),
            channel(plain.g, analytic.g, occluded.g, unoccluded.g),
            channel(plain.b, analytic.b, occluded.b, unoccluded.b)};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
