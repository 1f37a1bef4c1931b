#pragma once
#include "scene/box_tree.h"
#include "scene/closed_mesh/soup.h"

namespace airlight::closed_mesh {

/// Throws Error if triangles cross, but at edges and corners that they share; the tree is over
/// their boxes.
void check_crossings(const Soup& soup, std::span<const Bounds> boxes, const OrderedBoxTree& tree);

}  // namespace airlight::closed_mesh
