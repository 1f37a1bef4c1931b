#pragma once
#include <airlight/math/vec.h>

namespace airlight {

struct Scene;

/// The smallest box along the axes around all objects.  [m]
struct Bounds {
  Vec3<double> low{far_away, far_away, far_away};
  Vec3<double> high{-far_away, -far_away, -far_away};

  bool empty() const noexcept { return low.x > high.x; }
  void extend(Vec3<double> p) noexcept {
    low = {min(low.x, p.x), min(low.y, p.y), min(low.z, p.z)};
    high = {max(high.x, p.x), max(high.y, p.y), max(high.z, p.z)};
  }
};

/// Empty if the scene has no objects.
Bounds bounds_of(const Scene& scene);

}  // namespace airlight
