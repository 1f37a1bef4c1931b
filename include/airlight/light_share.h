#pragma once
#include <cstdint>

#include "math/simd.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The samples that a light gets of a ray where each sample asks one light only: those whose
/// number, times the sum of all lights' weights, falls on this light's. Picked with probability
/// weight / total, the light counts for total / weight as much (Velinov 2021 section 1.1).
template <Real F>
struct LightShare {
  F below;   ///< the sum of the weights of the lights before this one
  F weight;  ///< >= 0
  F total;   ///< of all lights' weights

  /// Whether the light is the one for u in [0, 1), and u made uniform in [0, 1] again if so: one
  /// number serves both, and strata stay strata.
  Mask<F> takes(F& u) const noexcept {
    const F x = u * total;
    u = clamp((x - below) / select(weight > F(0), weight, F(1)), F(0), F(1));
    return (x >= below) & (x < below + weight);
  }

  /// What a sample of the light counts for; of a light that is all but never picked, finite.
  F boost() const noexcept { return min(total / select(weight > F(0), weight, F(1)), F(1e30f)); }
};

}  // namespace airlight::inline AIRLIGHT_ISA
