#pragma once
#include <variant>

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

}  // namespace airlight::inline AIRLIGHT_ISA
