#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace airlight {

/// Boxes along the axes around things, and boxes around those: to find the few things that a line
/// or a plane comes near. Plain data, so that it is the same for every instruction set.
struct BoxTree {
  using Point = std::array<double, 3>;

  /// A box, a little larger than what it is around. A leaf holds the things first to
  /// first + count − 1; other nodes hold none.
  struct Node {
    Point middle, half;  ///< [m]
    std::uint32_t first = 0, count = 0, next = 0;
  };
  /// In depth-first order: the first child follows its parent, `next` comes where a box is left
  /// out.
  std::vector<Node> nodes;
};

inline namespace AIRLIGHT_ISA {

inline Vec3<double> point_of(const BoxTree::Point& p) noexcept { return {p[0], p[1], p[2]}; }

/// How far a linear function with gradient g varies over a box, either way from its middle.
inline double half_range(Vec3<double> g, Vec3<double> half) noexcept {
  return std::abs(g.x) * half.x + std::abs(g.y) * half.y + std::abs(g.z) * half.z;
}

/// Calls visit(i) with the number of each thing in boxes that `leave_out(middle, half)` keeps.
template <class LeaveOut, class Visit>
void for_each_near(const BoxTree& tree, LeaveOut&& leave_out, Visit&& visit) {
  for (std::size_t i = 0; i < tree.nodes.size();) {
    const BoxTree::Node& node = tree.nodes[i];
    if (leave_out(point_of(node.middle), point_of(node.half))) {
      i = node.next;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) visit(k);
    ++i;
  }
}

}  // namespace AIRLIGHT_ISA

}  // namespace airlight
