#pragma once
#include "lights.h"
#include "medium.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Why a light lights no part of a medium, whatever stands between them; null: it may.
inline const char* never_arrives(const Medium& medium, const Lights& light) noexcept {
  return std::holds_alternative<Unbounded>(medium.shape) &&
                 std::holds_alternative<Directional>(light)
             ? "a directional light never arrives in an unbounded medium, as all of it is lost on "
               "its way from infinitely far; give the medium a shape with an end, or leave out the "
               "light"
             : nullptr;
}

}  // namespace airlight::inline AIRLIGHT_ISA
