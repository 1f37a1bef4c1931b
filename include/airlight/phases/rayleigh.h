#pragma once
#include "../describe.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Rayleigh's phase function of particles much smaller than the wavelength: air, fine smoke.
///
///     p(cos θ) = 3 (1 + cos² θ) / (16π)    [1/sr]
struct Rayleigh {
  static constexpr auto name = "rayleigh";
  static constexpr auto meaning = "particles much smaller than the wavelength; air and fine smoke";

  template <class Visitor>
  static constexpr void describe(Visitor&&) {}

  /// Value and, being normalised over the sphere, also the density of `sample`.  [1/sr]
  template <Real F>
  F operator()(F cos_theta) const noexcept {
    return F(3 / (16 * pi)) * fma(cos_theta, cos_theta, F(1));
  }

  /// cos θ drawn from the phase function: the cubic c³ + 3c = 8u − 4 solved by c = r − 1/r (Frisvad
  /// 2011), the cube root by exp and log. Total on u in [0, 1].
  template <Real F>
  F sample(F u) const noexcept {
    const F half = abs(F(4) * u - F(2));  // by symmetry the branch where r >= 1 loses no digits
    const F r = exp(log(half + sqrt(fma(half, half, F(1)))) * F(1. / 3));
    const F c = min(r - F(1) / r, F(1));
    return select(u < F(0.5), -c, c);
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
