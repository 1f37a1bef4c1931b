#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// A round window of coloured panes in a stone wall, facing ±z, its middle at the origin.
struct RoseWindowObject : PlacedObject {
  double radius = 2;
  std::int64_t petals = 12;
  double bar = 0.1;
  double thickness = 0.3;
  double wall_width = 6;
  double wall_height = 6;
  double wall_below = 3;
  Rgb<double> albedo{0.5, 0.46, 0.4};

  static constexpr auto name = "rose_window";
  static constexpr auto meaning = "a round window of coloured panes in a stone wall";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = RoseWindowObject;
    field("radius", &O::radius, unit::metre, above(0), "of the round opening");
    field("petals", &O::petals, unit::none, closed(4, 64), "panes around the middle one");
    field("bar", &O::bar, unit::metre, above(0), "stone between panes, at the widest ring");
    field("thickness", &O::thickness, unit::metre, above(0), "of wall and tracery");
    field("wall_width", &O::wall_width, unit::metre, above(0), "of the wall, half on either side");
    field("wall_height", &O::wall_height, unit::metre, above(0), "of the wall");
    field("wall_below", &O::wall_below, unit::metre, above(0),
          "of the wall's height, below the middle");
    field("albedo", &O::albedo, unit::one, closed(0, 1), "of the stone");
    PlacedObject::describe(field);
  }

  /// Throws Error for a window that is not inside the wall, or bars that leave no panes.
  Parts build(const Cursor& at) const;
};

}  // namespace airlight
