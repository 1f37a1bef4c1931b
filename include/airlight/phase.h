#pragma once
#include "describe.h"

namespace airlight::inline AIRLIGHT_ISA {

/// How a medium redistributes light: a density over the sphere of directions and a way to draw from
/// it. The argument is cos θ between the directions of travel before and after: +1 goes straight
/// on.
template <class P>
concept Phase = requires(const P phase, double x, float y) {
  { P::name } -> std::convertible_to<const char*>;
  { P::meaning } -> std::convertible_to<const char*>;
  { phase(x) } -> std::same_as<double>;
  { phase.sample(x) } -> std::same_as<double>;
  { phase(y) } -> std::same_as<float>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
