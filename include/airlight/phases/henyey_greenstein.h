#pragma once
#include "../describe.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Henyey and Greenstein's phase function (1941), the usual one for fog and dust.
///
///     p(cos θ) = (1 − g²) / (4π (1 + g² − 2 g cos θ)^{3/2})    [1/sr]
///
/// θ lies between the directions of travel before and after scattering; g > 0 scatters forward.
struct HenyeyGreenstein {
  double g = 0;  ///< mean cosine of the scattering angle; 0 is isotropic

  static constexpr auto name = "henyey-greenstein";
  static constexpr auto meaning = "a forward or backward lobe of one parameter; fog and dust";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("g", &HenyeyGreenstein::g, unit::one, open(-1, 1),
          "mean cosine of the scattering angle; 0 is isotropic, above 0 forward");
  }

  /// Value and, being normalised over the sphere, also the density of `sample`.  [1/sr]
  template <Real F>
  F operator()(F cos_theta) const noexcept {
    // 1 + g² − 2 g cos θ as (1 − |g|)² + 2 |g| (1 ∓ cos θ): no cancellation towards the lobe.
    const double a = g < 0 ? -g : g;
    const F toward = g < 0 ? F(1) + cos_theta : F(1) - cos_theta;
    const F d = fma(F(2 * a), max(toward, F(0)), F((1 - a) * (1 - a)));
    // One after the other: d^{3/2} may be too small a number where the lobe is sharp.
    return F((1 - a) * (1 + a) / (4 * pi)) / d / sqrt(d);
  }

  /// cos θ drawn from the phase function: its distribution function inverted, total on u in [0, 1].
  /// Written about k, the sample of Schlick's phase function of eccentricity g: nothing is divided
  /// by g, so that all of u counts however nearly isotropic the medium is.
  template <Real F>
  F sample(F u) const noexcept {
    const F k = (F(2) * u - F(1 - g)) / fma(F(2 * g), u, F(1 - g));
    return clamp(fma(F(0.5 * g), F(1) - k * k, k), F(-1), F(1));
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
