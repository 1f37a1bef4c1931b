#include "scene/box_tree.h"

#include <algorithm>
#include <numeric>

namespace airlight {
namespace {

class Grower {
 public:
  explicit Grower(std::span<const Bounds> things) : things_(things), result_{{}, {}} {
    for (const Bounds& b : things)
      for (const double x : {b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z})
        slack_ = std::max(slack_, 1e-9 * std::abs(x));
    result_.order.resize(things.size());
    std::iota(result_.order.begin(), result_.order.end(), std::size_t(0));
    if (!things.empty()) grow(0, things.size());
  }

  OrderedBoxTree take() { return std::move(result_); }

 private:
  /// The node over order[first] to order[end − 1], halved across its longest side.
  void grow(std::size_t first, std::size_t end) {
    constexpr std::size_t leaf = 4;
    auto& [tree, order] = result_;
    Bounds bounds, centres;
    for (std::size_t i = first; i < end; ++i) {
      const Bounds& thing = things_[order[i]];
      bounds.extend(thing.min), bounds.extend(thing.max);
      centres.extend(thing.centre());
    }
    const Vec3<double> middle = bounds.centre(), half = bounds.size() * 0.5;
    const std::size_t node = tree.nodes.size();
    tree.nodes.push_back(
        {{middle.x, middle.y, middle.z}, {half.x + slack_, half.y + slack_, half.z + slack_}});
    if (end - first <= leaf) {
      tree.nodes[node].first = std::uint32_t(first);
      tree.nodes[node].count = std::uint32_t(end - first);
    } else {
      const Vec3<double> extent = centres.size();
      const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                       : extent.y >= extent.z                       ? 1
                                                                    : 2;
      const std::size_t half_way = (first + end) / 2;
      const auto at = [&](std::size_t i) { return order.begin() + std::ptrdiff_t(i); };
      std::nth_element(at(first), at(half_way), at(end), [&](std::size_t a, std::size_t b) {
        return things_[a].centre()[axis] < things_[b].centre()[axis];
      });
      grow(first, half_way);
      grow(half_way, end);
    }
    tree.nodes[node].next = std::uint32_t(tree.nodes.size());
  }

  std::span<const Bounds> things_;
  double slack_ = 0;  ///< by which boxes are larger than what they are around  [m]
  OrderedBoxTree result_;
};

}  // namespace

OrderedBoxTree tree_over(std::span<const Bounds> things) { return Grower(things).take(); }

}  // namespace airlight
