#pragma once
#include <array>
#include <vector>

#include "scene/objects/keys.h"

namespace airlight {

/// Several boxes along the axes as one object: a piece of furniture.
struct BoxesObject : SurfacedObject {
  Required<std::vector<std::array<double, 6>>> boxes;

  static constexpr auto name = "boxes";
  static constexpr auto meaning = "several boxes along the axes as one object, such as a table";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("boxes", &BoxesObject::boxes, unit::metre, any_number(),
          "of each the lower corner, then the upper: [x, y, z, x, y, z]");
    SurfacedObject::describe(field);
  }

  /// Throws Error for a box that is empty or inverted, or if there is none.
  Parts build(const Cursor& at) const;
};

}  // namespace airlight
