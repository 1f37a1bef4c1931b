#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// A solid box, oriented at will.
struct BoxObject : SurfacedObject {
  Vec3<double> min{-1, -1, -1};
  Vec3<double> max{1, 1, 1};
  Vec3<double> rotation{0, 0, 0};

  static constexpr auto name = "box";
  static constexpr auto meaning = "a box between two corners";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = BoxObject;
    field("min", &O::min, unit::metre, any_number(), "the lower corner before the rotation");
    field("max", &O::max, unit::metre, any_number(), "the upper corner before the rotation");
    field("rotation", &O::rotation, unit::degree, any_number(),
          "turn about x, then y, then z, through the centre of the box");
    SurfacedObject::describe(field);
  }

  Parts build(const Cursor& at) const;
};

}  // namespace airlight
