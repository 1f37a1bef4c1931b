#pragma once
#include <vector>

#include "scene/scene.h"

namespace airlight {

/// The box along the axes around something; empty if min lies above max.  [m]
struct Bounds {
  Vec3<double> min{far_away, far_away, far_away};
  Vec3<double> max{-far_away, -far_away, -far_away};

  bool empty() const noexcept { return min.x > max.x; }
  Vec3<double> centre() const noexcept { return (min + max) * 0.5; }
  Vec3<double> size() const noexcept { return max - min; }

  void extend(Vec3<double> p) noexcept {
    min = {airlight::min(min.x, p.x), airlight::min(min.y, p.y), airlight::min(min.z, p.z)};
    max = {airlight::max(max.x, p.x), airlight::max(max.y, p.y), airlight::max(max.z, p.z)};
  }
};

/// Around all surfaces; vertices that no triangle uses do not count.
Bounds bounds_of(const std::vector<Object>& objects);

}  // namespace airlight
