#include "scene/closed_mesh/tree.h"

#include <algorithm>
#include <numeric>

namespace airlight::closed_mesh {
namespace {

/// The tree over order[first] to order[end − 1], halved across its longest side.
void grow(Tree& tree, const Soup& soup, std::size_t first, std::size_t end) {
  constexpr std::size_t leaf = 4;
  auto& [order, nodes] = tree;
  Bounds bounds, middles;
  const auto middle_of = [&](std::size_t k) {
    return (soup.corner(k, 0) + soup.corner(k, 1) + soup.corner(k, 2)) * (1. / 3);
  };
  for (std::size_t i = first; i < end; ++i) {
    for (int j = 0; j < 3; ++j) bounds.extend(soup.corner(order[i], j));
    middles.extend(middle_of(order[i]));
  }
  const double slack = 1e-9 * soup.size;
  const Vec middle = bounds.centre();
  const Vec half = bounds.size() * 0.5 + Vec(slack, slack, slack);
  const std::size_t node = nodes.size();
  nodes.push_back({{middle.x, middle.y, middle.z}, {half.x, half.y, half.z}, 0, 0, 0});
  if (end - first <= leaf) {
    nodes[node].first = std::uint32_t(first);
    nodes[node].count = std::uint32_t(end - first);
  } else {
    const Vec extent = middles.size();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t half_way = (first + end) / 2;
    const auto at = [&](std::size_t i) { return order.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(first), at(half_way), at(end), [&](std::size_t a, std::size_t b) {
      return middle_of(a)[axis] < middle_of(b)[axis];
    });
    grow(tree, soup, first, half_way);
    grow(tree, soup, half_way, end);
  }
  nodes[node].next = std::uint32_t(nodes.size());
}

}  // namespace

Tree tree_over(const Soup& soup) {
  Tree tree;
  tree.order.resize(soup.triangles.size());
  std::iota(tree.order.begin(), tree.order.end(), std::size_t(0));
  grow(tree, soup, 0, tree.order.size());
  return tree;
}

Bounds bounds_of(const Soup& soup, std::size_t triangle) {
  Bounds bounds;
  for (int i = 0; i < 3; ++i) bounds.extend(soup.corner(triangle, i));
  return bounds;
}

}  // namespace airlight::closed_mesh
