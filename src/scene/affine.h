#pragma once
#include <airlight/math/vec.h>

#include <cmath>

namespace airlight {

/// A map of space that keeps lines straight: p ↦ x p.x + y p.y + z p.z + origin.
struct Affine {
  Vec3<double> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< where the axes go
  Vec3<double> origin{0, 0, 0};

  Vec3<double> vector(const Vec3<double>& v) const noexcept { return x * v.x + y * v.y + z * v.z; }
  Vec3<double> point(const Vec3<double>& p) const noexcept { return vector(p) + origin; }

  /// Where a plane's normal goes, of any length: by the cofactors, so that flattening maps do not
  /// divide by zero.
  Vec3<double> normal(const Vec3<double>& n) const noexcept {
    const Vec3<double> image = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return dot(x, cross(y, z)) < 0 ? -image : image;
  }

  /// The right one first.
  friend Affine operator*(const Affine& a, const Affine& b) noexcept {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.origin)};
  }
};

}  // namespace airlight
