#pragma once
#include <airlight/box_tree.h>

#include <span>

#include "scene/bounds.h"

namespace airlight {

/// A tree over boxes along the axes, and the order in which its leaves hold them.
struct OrderedBoxTree {
  BoxTree tree;
  std::vector<std::size_t> order;
};

OrderedBoxTree tree_over(std::span<const Bounds> things);

}  // namespace airlight
