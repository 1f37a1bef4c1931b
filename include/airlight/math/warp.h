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

/// The direction that leaves the unit vector `axis` by an angle θ, given by 1 − cos θ, and is
/// turned about it by u of a turn.
template <Real F>
Vec3<F> turned(Vec3<F> axis, F one_minus_cos, F u) noexcept {
  Vec3<F> e1, e2;
  orthonormal_basis(axis, e1, e2);
  F sine, cosine;
  sin_cos_turn(u, sine, cosine);
  const F sin_theta = sqrt(max(one_minus_cos * (F(2) - one_minus_cos), F(0)));
  return e1 * (sin_theta * cosine) + e2 * (sin_theta * sine) + axis * (F(1) - one_minus_cos);
}

/// A direction drawn uniformly from the cap of half-angle acos(1 − height) about the unit vector
/// `axis`.
template <Real F>
Vec3<F> uniform_cap(Vec3<F> axis, F height, Vec2<F> u) noexcept {
  return turned(axis, height * u.x, u.y);
}

/// A direction drawn from the hemisphere about the unit vector `axis` with density cos θ / π.
template <Real F>
Vec3<F> cosine_hemisphere(Vec3<F> axis, Vec2<F> u) noexcept {
  return turned(axis, F(1) - sqrt(F(1) - u.x), u.y);
}

}  // namespace airlight::inline AIRLIGHT_ISA
