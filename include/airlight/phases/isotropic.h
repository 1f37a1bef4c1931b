#pragma once
#include "../describe.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Scatters alike in all directions.
///
///     p(cos θ) = 1 / (4π)    [1/sr]
struct Isotropic {
  static constexpr auto name = "isotropic";
  static constexpr auto meaning = "scatters alike in all directions";

  template <class Visitor>
  static constexpr void describe(Visitor&&) {}

  /// Value and, being normalised over the sphere, also the density of `sample`.  [1/sr]
  template <Real F>
  F operator()(F) const noexcept {
    return F(1 / (4 * pi));
  }

  /// cos θ drawn from the phase function, total on u in [0, 1].
  template <Real F>
  F sample(F u) const noexcept {
    return F(2) * u - F(1);
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
