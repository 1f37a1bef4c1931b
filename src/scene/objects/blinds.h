#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// Flat slats one above the other, as wide as the window behind them. They hang at z = 0 from the
/// origin to the right and up; rotate and translate put them up.
struct BlindsObject : SurfacedObject {
  double width = 1;
  double height = 1.5;
  std::int64_t slats = 30;
  double slat_width = 0.05;
  double tilt = 30;

  static constexpr auto name = "blinds";
  static constexpr auto meaning = "flat slats along x, one above the other from y = 0 on";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = BlindsObject;
    field("width", &O::width, unit::metre, above(0), "length of the slats");
    field("height", &O::height, unit::metre, above(0), "from the first slat's place to the last's");
    field("slats", &O::slats, unit::none, closed(1, 10000), "how many there are, evenly spaced");
    field("slat_width", &O::slat_width, unit::metre, above(0), "of one slat, across");
    field("tilt", &O::tilt, unit::degree, closed(-90, 90),
          "0 lets level light through; above 0 the edge at +z is lifted");
    SurfacedObject::describe(field);
  }

  Parts build(const Cursor&) const;
};

}  // namespace airlight
