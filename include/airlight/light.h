#pragma once
#include "describe.h"
#include "math/vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What sends light into a scene.
template <class L>
concept Light = requires {
  { L::name } -> std::convertible_to<const char*>;
  { L::meaning } -> std::convertible_to<const char*>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
