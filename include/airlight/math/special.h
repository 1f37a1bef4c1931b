#pragma once
#include "simd.h"

namespace airlight::inline AIRLIGHT_ISA {

/// φ(y) = (1 − e^{−y}) / y, φ(0) = 1, the mean of e^{−x} over [0, y], for y in [0, 1]: minimax
/// polynomials. Relative error 1.1e-7 in float (degree 6), 4e-16 in double (degree 13).
template <Real F>
AIRLIGHT_INLINE F phi_below_one(F y) noexcept {
  if constexpr (std::same_as<F, double>) {
    constexpr double c[] = {1,
                            -0.5,
                            0.16666666666666657,
                            -0.041666666666664251,
                            0.0083333333333009989,
                            -0.0013888888886293793,
                            0.00019841269706207544,
                            -2.4801582524092862e-5,
                            2.7557201235631274e-6,
                            -2.7555260613089597e-7,
                            2.5026785756368367e-8,
                            -2.0661045908143847e-9,
                            1.4837007128194299e-10,
                            -7.2229153113293327e-12};
    double p = c[13];
    for (int i = 12; i >= 0; --i) p = fma(p, y, c[i]);
    return p;
  } else {
    F p = F(0.00012907631f);
    p = fma(p, y, F(-0.0013007750f));
    p = fma(p, y, F(0.0082755048f));
    p = fma(p, y, F(-0.041646849f));
    p = fma(p, y, F(0.16666340f));
    p = fma(p, y, F(-0.49999980f));
    return fma(p, y, F(1));
  }
}

/// φ(y) for every y >= 0. The plain quotient is wrong by 100 % below y ~ 6e-8 in float.
template <Real F>
F phi(F y) noexcept {
  return select(y < F(1), phi_below_one(y), (F(1) - exp(-y)) / max(y, F(1)));
}

/// 1 − e^{−y} for y >= 0, without cancellation.
template <Real F>
AIRLIGHT_INLINE F one_minus_exp(F y) noexcept {
  return select(y < F(1), y * phi_below_one(y), F(1) - exp(-y));
}

/// log(1 − z) for z in [0, 1], finite also at z = 1: the log of the smallest normal number there.
/// The batch corrects the rounding of 1 − z after Kahan, which holds only without -ffast-math.
template <Real F>
AIRLIGHT_INLINE F log1p_minus(F z) noexcept {
  if constexpr (std::floating_point<F>) {
    return std::log1p(-min(z, F(1) - std::numeric_limits<F>::epsilon() / 2));
  } else {
    const F r = F(1) - z;
    return select(r == F(1), -z, log(max(r, F(1e-38f))) * z / max(F(1) - r, F(1e-38f)));
  }
}

/// The part g in [0, 1] of an interval over which e^{−y g} holds the part v of its integral, y >= 0
/// and drop = 1 − e^{−y}:
///
///     g = −log(1 − v drop) / y
template <Real F>
AIRLIGHT_INLINE F exponential_fraction(F y, F drop, F v) noexcept {
  // Below this depth the quotient divides rounding by y; the series is exact to y^2.
  const F small(std::same_as<F, double> ? 1e-5 : 2e-3);
  const F w = F(1) - v;
  const F series = v * (F(1) - y * w * F(0.5) + y * y * w * (w - v) * F(1. / 6));
  const F z = min(v * drop, F(1)), steep = max(y, small);
  F inverse;
  if constexpr (std::floating_point<F>) {
    inverse = -log1p_minus(z) / steep;
  } else {  // the same with one division
    const F r = F(1) - z, lost = F(1) - r;
    inverse = select(lost == F(0), z, -log(max(r, F(1e-38f))) * z) /
              (select(lost == F(0), F(1), lost) * steep);
  }
  return clamp(select(y < small, series, inverse), F(0), F(1));
}

template <Real F>
F exponential_fraction(F y, F v) noexcept {
  return exponential_fraction(y, one_minus_exp(y), v);
}

}  // namespace airlight::inline AIRLIGHT_ISA
