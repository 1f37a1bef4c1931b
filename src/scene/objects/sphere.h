#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// An exact sphere.
struct SphereObject : SurfacedObject {
  Vec3<double> centre{0, 0, 0};
  double radius = 1;

  static constexpr auto name = "sphere";
  static constexpr auto meaning = "an exact sphere";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = SphereObject;
    field("centre", &O::centre, unit::metre, any_number(), "its middle");
    field("radius", &O::radius, unit::metre, above(0), "from the middle to the surface");
    SurfacedObject::describe(field);
  }

  Parts build(const Cursor&) const { return single_part(Sphere{centre, radius}); }
};

}  // namespace airlight
