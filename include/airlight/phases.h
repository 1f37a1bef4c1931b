#pragma once
#include <variant>

#include "math/warp.h"
#include "phase.h"
#include "phases/henyey_greenstein.h"
#include "phases/isotropic.h"
#include "phases/rayleigh.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every phase function there is. To add one: its file in phases/ and its name here.
using Phases = std::variant<Isotropic, HenyeyGreenstein, Rayleigh>;

/// The phase function's value at cos θ.  [1/sr]
template <Real F>
F evaluate(const Phases& phases, F cos_theta) noexcept {
  return std::visit([&](const Phase auto& phase) { return phase(cos_theta); }, phases);
}

/// A direction of travel drawn from the phase function, after a unit vector before.
template <Real F>
Vec3<F> scattered_direction(const Phases& phases, Vec3<F> before, Vec2<F> u) noexcept {
  const F cos_theta =
      std::visit([&](const Phase auto& phase) { return phase.sample(u.x); }, phases);
  return turned(before, F(1) - cos_theta, u.y);
}

}  // namespace airlight::inline AIRLIGHT_ISA
