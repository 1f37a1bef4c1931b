#pragma once
#include <variant>

#include "lights/collimated.h"
#include "lights/directional.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every kind of light there is. To add one: its file in lights/ and its name here.
using Lights = std::variant<Directional, Collimated>;

static_assert(ParallelLight<Directional> && ParallelLight<Collimated>);

}  // namespace airlight::inline AIRLIGHT_ISA
