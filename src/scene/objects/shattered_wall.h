#pragma once
#include <array>

#include "scene/objects/keys.h"

namespace airlight {

/// A wall that a blow breaks into convex pieces. It stands as `wall` does, on the x axis, from the
/// origin to the right; the blow comes from −z, and what it loosens flies towards +z and falls onto
/// the floor, y = 0. Where everything is follows from `time` alone.
struct ShatteredWallObject : SurfacedObject {
  double width = 4;
  double height = 3;
  double thickness = 0.2;
  std::int64_t pieces = 300;
  std::array<double, 2> impact{2, 1.4};
  double radius = 1.2;
  double speed = 5;
  double time = 0;
  std::int64_t seed = 0;

  static constexpr auto name = "shattered_wall";
  static constexpr auto meaning = "a wall that a blow breaks into pieces, which fly and fall";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = ShatteredWallObject;
    field("width", &O::width, unit::metre, above(0), "from x = 0 on");
    field("height", &O::height, unit::metre, above(0), "from y = 0, the floor, on");
    field("thickness", &O::thickness, unit::metre, above(0), "half on either side of z = 0");
    field("pieces", &O::pieces, unit::none, closed(2, 4096),
          "of the whole wall, smaller about the impact");
    field("impact", &O::impact, unit::metre, any_number(), "x and y of where the blow meets it");
    field("radius", &O::radius, unit::metre, above(0),
          "about the impact, within which, more or less, pieces come loose");
    field("speed", &O::speed, unit::metre_per_second, above(0), "of the pieces about the impact");
    field("time", &O::time, unit::second, any_number(),
          "since the blow; up to 0 the wall is whole: the number to animate");
    field("seed", &O::seed, unit::none, closed(0, 4294967295.), "another seed, other pieces");
    SurfacedObject::describe(field);
  }

  Parts build(const Cursor& at) const;
};

}  // namespace airlight
