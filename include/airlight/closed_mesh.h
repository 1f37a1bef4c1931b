#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "box_tree.h"

namespace airlight {

/// Triangles that close off a body without touching each other but at shared edges and corners, and
/// a tree of boxes over them. Plain data, so that it is the same for every instruction set; whoever
/// makes one sees to the promises below (the renderer's `close_mesh` proves them).
struct ClosedMesh {
  using Point = BoxTree::Point;

  /// No plane cuts more triangles: what is kept along a ray has a fixed size.
  static constexpr int most_cut = 640;

  std::vector<Point> corners;  ///< about `centre`  [m]
  /// Anticlockwise seen from outside. Triangles that share an edge share its corners.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Point centre{};  ///< the origin of the corners' coordinates  [m]
  BoxTree tree;    ///< over the triangles
};

}  // namespace airlight
