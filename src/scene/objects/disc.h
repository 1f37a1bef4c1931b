#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// A flat disc, as a regular polygon of many corners.
struct DiscObject : SurfacedObject {
  Vec3<double> centre{0, 0, 0};
  Vec3<double> normal{0, 1, 0};
  double radius = 1;
  std::int64_t corners = 64;

  static constexpr auto name = "disc";
  static constexpr auto meaning = "a flat disc; with few corners a regular polygon";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = DiscObject;
    field("centre", &O::centre, unit::metre, any_number(), "its middle");
    field("normal", &O::normal, unit::none, any_number(), "what it faces, of any length");
    field("radius", &O::radius, unit::metre, above(0), "from the middle to a corner");
    field("corners", &O::corners, unit::none, closed(3, 10000),
          "of the polygon that stands for it");
    SurfacedObject::describe(field);
  }

  /// Throws Error if it faces nowhere.
  Parts build(const Cursor& at) const;
};

}  // namespace airlight
