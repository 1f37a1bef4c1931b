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

/// log(1 − z) for z in [0, 1], also where z is tiny, and finite at z = 1: the log of the smallest
/// normal number there. Relative error 2e-7 in float.
template <Real F>
AIRLIGHT_INLINE F log1p_minus(F z) noexcept {
  if constexpr (std::floating_point<F>) {
    return std::log1p(-min(z, F(1) - std::numeric_limits<F>::epsilon() / 2));
  } else {
    // 1 − z = 2^e (1 + f), f in [√½ − 1, √2 − 1]. For e = 0, f is −z itself and not what the
    // rounding of 1 − z leaves of it.
    F f;
    const F e = split_at_sqrt_half(max(F(1) - z, F(std::numeric_limits<float>::min())), f);
    f = select(e == F(0), -z, f);
    // log(1 + f) = f − f²/2 + s (f²/2 + R(s²)), s = f / (2 + f); R's coefficients are fdlibm's.
    const F s = f / (F(2) + f), s2 = s * s, half_square = F(0.5f) * f * f;
    F r = fma(s2, F(0.24279078841f), F(0.28498786688f));
    r = fma(s2, r, F(0.40000972152f));
    r = fma(s2, r, F(0.66666662693f)) * s2;
    return fma(e, F(0.693147180560f), f - (half_square - s * (half_square + r)));
  }
}

/// The part g in [0, 1] of an interval over which e^{−y g} holds the part v of its integral, y >= 0
/// and drop = 1 − e^{−y}:
///
///     g = −log(1 − v drop) / y
template <Real F>
AIRLIGHT_INLINE F exponential_fraction(F y, F drop, F v) noexcept {
  const F flat(std::same_as<F, double> ? 1e-15 : 1e-7);  // e^{−y} is 1 to rounding
  const F curved = -log1p_minus(min(v * drop, F(1))) / max(y, flat);
  return select(y < flat, v, min(curved, F(1)));
}

template <Real F>
F exponential_fraction(F y, F v) noexcept {
  return exponential_fraction(y, one_minus_exp(y), v);
}

}  // namespace airlight::inline AIRLIGHT_ISA
