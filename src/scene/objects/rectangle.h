#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// A flat rectangle or, with edges that are not perpendicular, parallelogram.
struct RectangleObject : SurfacedObject {
  Vec3<double> corner{-1, 0, -1};
  Vec3<double> u{2, 0, 0};
  Vec3<double> v{0, 0, 2};

  static constexpr auto name = "rectangle";
  static constexpr auto meaning = "a flat rectangle between two edges";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = RectangleObject;
    field("corner", &O::corner, unit::metre, any_number(), "where both edges start");
    field("u", &O::u, unit::metre, any_number(), "the edge along which a texture's u runs");
    field("v", &O::v, unit::metre, any_number(), "the edge along which a texture's v runs");
    SurfacedObject::describe(field);
  }

  /// Throws Error for edges that span no area.
  Parts build(const Cursor& at) const;
};

}  // namespace airlight
