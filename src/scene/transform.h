#pragma once
#include <airlight/describe.h>
#include <airlight/math/vec.h>

#include "scene/rotation.h"

namespace airlight {

/// Where a scene file puts something that has coordinates of its own.
struct Transform {
  double scale = 1;
  Vec3<double> rotate{0, 0, 0};
  Vec3<double> translate{0, 0, 0};

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using T = Transform;
    field("scale", &T::scale, unit::one, closed(1e-6, 1e6), "about the origin, before the turn");
    field("rotate", &T::rotate, unit::degree, any_number(),
          "about the x axis, then y, then z, through the origin");
    field("translate", &T::translate, unit::metre, any_number(), "where its origin is put");
  }

  bool is_none() const {
    return scale == 1 && rotate == Vec3<double>() && translate == Vec3<double>();
  }

  /// What it does to a point.
  auto mapping() const {
    return [turn = Rotation(rotate), *this](Vec3<double> p) { return translate + turn(p * scale); };
  }
};

}  // namespace airlight
