#pragma once
#include <airlight/describe.h>
#include <airlight/math/rotation.h>

namespace airlight {

/// Where a scene file puts something that has coordinates of its own.
struct Transform {
  double scale = 1;
  Vec3<double> rotate{0, 0, 0};
  Vec3<double> translate{0, 0, 0};

  /// Describes the keys as those of the struct derived from this one.
  template <class Owner, class Visitor>
  static constexpr void describe_of(Visitor&& field) {
    field("scale", static_cast<double Owner::*>(&Transform::scale), unit::one, closed(1e-6, 1e6),
          "about the origin, before the turn");
    field("rotate", static_cast<Vec3<double> Owner::*>(&Transform::rotate), unit::degree,
          any_number(), "about the x axis, then y, then z, through the origin");
    field("translate", static_cast<Vec3<double> Owner::*>(&Transform::translate), unit::metre,
          any_number(), "where its origin is put");
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
