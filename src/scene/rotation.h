#pragma once
#include <airlight/math/vec.h>

namespace airlight {

/// A turn about the x axis, then y, then z, in degrees; seen against the axis it goes
/// counter-clockwise.
class Rotation {
 public:
  explicit Rotation(Vec3<double> degrees) {
    const auto radians = degrees * (pi / 180);
    const double sx = std::sin(radians.x), cx = std::cos(radians.x);
    const double sy = std::sin(radians.y), cy = std::cos(radians.y);
    const double sz = std::sin(radians.z), cz = std::cos(radians.z);
    x_ = {cy * cz, cy * sz, -sy};
    y_ = {sx * sy * cz - cx * sz, sx * sy * sz + cx * cz, sx * cy};
    z_ = {cx * sy * cz + sx * sz, cx * sy * sz - sx * cz, cx * cy};
  }

  Vec3<double> operator()(Vec3<double> v) const { return x_ * v.x + y_ * v.y + z_ * v.z; }

 private:
  Vec3<double> x_, y_, z_;  ///< where the axes go
};

}  // namespace airlight
