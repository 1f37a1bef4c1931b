#pragma once
#include <array>

#include "scene/objects/keys.h"

namespace airlight {

/// A wall with a window: a grid of openings between bars. It stands on the x axis, from the origin
/// to the right, half of its thickness on either side of z = 0; rotate and translate put it up.
struct WallObject : SurfacedObject {
  double width = 4;
  double height = 3;
  double thickness = 0.3;
  std::array<double, 2> window_min{1, 1};
  std::array<double, 2> window_max{3, 2.5};
  std::int64_t columns = 2;
  std::int64_t rows = 2;
  double bar_width = 0.06;
  double bar_depth = 0.06;

  static constexpr auto name = "wall";
  static constexpr auto meaning = "a wall along x, standing on y = 0, with a grid of openings";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = WallObject;
    field("width", &O::width, unit::metre, above(0), "from x = 0 on");
    field("height", &O::height, unit::metre, above(0), "from y = 0 on");
    field("thickness", &O::thickness, unit::metre, above(0), "half on either side of z = 0");
    field("window_min", &O::window_min, unit::metre, at_least(0),
          "x and y of its lower left corner");
    field("window_max", &O::window_max, unit::metre, at_least(0),
          "x and y of its upper right corner");
    field("columns", &O::columns, unit::none, closed(1, 1000), "openings side by side");
    field("rows", &O::rows, unit::none, closed(1, 1000), "openings one above the other");
    field("bar_width", &O::bar_width, unit::metre, above(0), "of the bars between openings");
    field("bar_depth", &O::bar_depth, unit::metre, above(0), "of the bars between openings");
    SurfacedObject::describe(field);
  }

  /// Throws Error for a window that is not inside the wall, or bars that leave no opening.
  Parts build(const Cursor& at) const;
};

}  // namespace airlight
