#pragma once
#include "random.h"

namespace airlight::inline AIRLIGHT_ISA {

/// sin(x) and cos(x) of x = 2π u for u in [0, 1).
template <Real F>
void sin_cos_turn(F u, F& sine, F& cosine) noexcept {
  if constexpr (std::floating_point<F>) {
    sine = std::sin(F(2 * pi) * u);
    cosine = std::cos(F(2 * pi) * u);
  } else {
    const auto both = xsimd::sincos(F(float(2 * pi)) * u);
    sine = both.first;
    cosine = both.second;
  }
}

/// A direction drawn uniformly from the cap of half-angle acos(1 − height) about the unit vector
/// `axis`.
template <Real F>
Vec3<F> uniform_cap(Vec3<F> axis, F height, Vec2<F> u) noexcept {
  Vec3<F> e1, e2;
  orthonormal_basis(axis, e1, e2);
  F sine, cosine;
  sin_cos_turn(u.y, sine, cosine);
  const F h = height * u.x;  // 1 − cos θ
  const F sin_theta = sqrt(max(h * (F(2) - h), F(0)));
  return e1 * (sin_theta * cosine) + e2 * (sin_theta * sine) + axis * (F(1) - h);
}

}  // namespace airlight::inline AIRLIGHT_ISA
