#pragma once
#include <variant>

#include "shapes/box.h"
#include "shapes/convex.h"
#include "shapes/solid.h"
#include "shapes/unbounded.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every shape a medium can have. To add one: its file in shapes/ and its name here.
using Shapes = std::variant<Box, Convex, Unbounded, Solid>;

static_assert(ConvexShape<Box> && ConvexShape<Convex> && ConvexShape<Unbounded> && Shape<Solid>);

}  // namespace airlight::inline AIRLIGHT_ISA
