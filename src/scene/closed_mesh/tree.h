#pragma once
#include <vector>

#include "scene/bounds.h"
#include "scene/closed_mesh/soup.h"

namespace airlight::closed_mesh {

/// Boxes over triangles, and the order in which its leaves hold them.
struct Tree {
  std::vector<std::size_t> order;
  std::vector<ClosedMesh::Node> nodes;
};

Tree tree_over(const Soup& soup);

Bounds bounds_of(const Soup& soup, std::size_t triangle);

}  // namespace airlight::closed_mesh
