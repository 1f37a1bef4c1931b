#pragma once
#include "vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A turn about the x axis, then y, then z, in degrees; seen against the axis it goes
/// counter-clockwise.
class Rotation {
 public:
  explicit Rotation(Vec3<double> degrees) noexcept {
    const auto radians = degrees * (pi / 180);
    const double sx = std::sin(radians.x), cx = std::cos(radians.x);
    const double sy = std::sin(radians.y), cy = std::cos(radians.y);
    const double sz = std::sin(radians.z), cz = std::cos(radians.z);
    axes_[0] = {cy * cz, cy * sz, -sy};
    axes_[1] = {sx * sy * cz - cx * sz, sx * sy * sz + cx * cz, sx * cy};
    axes_[2] = {cx * sy * cz + sx * sz, cx * sy * sz - sx * cz, cx * cy};
  }

  /// Where the kth axis goes: a row of the inverse turn.
  const Vec3<double>& axis(int k) const noexcept { return axes_[k]; }

  Vec3<double> operator()(Vec3<double> v) const noexcept {
    return axes_[0] * v.x + axes_[1] * v.y + axes_[2] * v.z;
  }

 private:
  Vec3<double> axes_[3];
};

}  // namespace airlight::inline AIRLIGHT_ISA
