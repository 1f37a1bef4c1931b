#include "scene/closed_mesh/crossings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "error.h"

namespace airlight::closed_mesh {
namespace {

/// Where the segment from p to q passes through the inside of the triangle a b c, by more than
/// rounding.
std::optional<Vec> pierces(const Vec& p, const Vec& q, const Vec& a, const Vec& b, const Vec& c) {
  const double scale = std::max({length(q - p), length(b - a), length(c - a)});
  const double least = 1e-9 * scale * scale * scale;
  const auto volume = [](const Vec& u, const Vec& v, const Vec& w) { return dot(u, cross(v, w)); };
  const double at_p = volume(b - a, c - a, p - a), at_q = volume(b - a, c - a, q - a);
  if (!(std::min(at_p, at_q) < -least && std::max(at_p, at_q) > least)) return std::nullopt;
  const double ab = volume(q - p, a - p, b - p), bc = volume(q - p, b - p, c - p),
               ca = volume(q - p, c - p, a - p);
  const bool inside =
      (ab > least && bc > least && ca > least) || (ab < -least && bc < -least && ca < -least);
  if (!inside) return std::nullopt;
  return p + (q - p) * (at_p / (at_p - at_q));
}

/// Where two triangles cross, but at corners that they share, once the second is moved.
std::optional<Vec> crossing_of(const Soup& soup, std::size_t k, std::size_t l, const Vec& move) {
  const auto pierced_by = [&](std::size_t a, std::size_t b,
                              const Vec& ahead) -> std::optional<Vec> {
    const Triangle& t = soup.triangles[b];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t p = soup.triangles[a][std::size_t(i)];
      const std::uint32_t q = soup.triangles[a][std::size_t((i + 1) % 3)];
      if (std::ranges::find(t, p) != t.end() || std::ranges::find(t, q) != t.end()) continue;
      if (const auto at = pierces(soup.corners[p] + ahead, soup.corners[q] + ahead,
                                  soup.corner(b, 0), soup.corner(b, 1), soup.corner(b, 2)))
        return at;
    }
    return std::nullopt;
  };
  const auto at = pierced_by(k, l, move * -1.);
  return at ? at : pierced_by(l, k, move);
}

/// Where two triangles that share an edge lie on each other. Needles, whose side is a matter of
/// rounding, do not count.
std::optional<Vec> fold_of(const Soup& soup, std::size_t k, std::size_t l) {
  const Triangle &t = soup.triangles[k], &other = soup.triangles[l];
  int own = 0, others = 0, count = 0;  // corners that the other has not
  for (int i = 0; i < 3; ++i) {
    if (std::ranges::find(other, t[std::size_t(i)]) == other.end()) own = i, ++count;
    if (std::ranges::find(t, other[std::size_t(i)]) == t.end()) others = i;
  }
  if (count == 0) return soup.corner(k, 0);
  if (count > 1) return std::nullopt;
  const Vec a = soup.corner(k, own + 1), edge = soup.corner(k, own + 2) - a;
  const Vec p = soup.corner(k, own) - a, q = soup.corner(l, others) - a;
  const Vec left = cross(edge, p), right = cross(edge, q);
  const auto is_needle = [&](const Vec& area, const Vec& side) {
    return length(area) < 1e-6 * length(edge) * length(side);
  };
  if (is_needle(left, p) || is_needle(right, q) || !(dot(left, right) > 0) ||
      length(cross(left, right)) > 1e-9 * length(left) * length(right))
    return std::nullopt;
  return a + edge * 0.5;
}

/// Looks for triangles that cross. Of shells that overlap face on face or edge on edge, no edge
/// needs to pierce a triangle: such shells cross when one is moved a little, one way and the other,
/// where shells that only touch come apart one way.
class Crossings {
 public:
  explicit Crossings(const Soup& soup)
      : soup_(soup), nudge_(Vec(0.3713, 0.5521, 0.7469) * (1e-7 * soup.size)) {}

  /// Throws Error if two triangles cross, or if with those seen before they tell that shells do.
  void see(std::size_t k, std::size_t l) {
    auto at = fold_of(soup_, k, l);
    if (!at) at = crossing_of(soup_, k, l, Vec());
    const std::size_t a = soup_.components[k], b = soup_.components[l];
    if (!at && a != b) {
      const std::pair<std::size_t, std::size_t> shells = std::minmax(a, b);
      for (int side = 0; side < 2; ++side)
        if (const auto moved = crossing_of(soup_, k, l, nudge_ * ((side == 0) == (a < b) ? 1 : -1)))
          crossed_[side].insert(shells), at = moved;
      if (!crossed_[0].contains(shells) || !crossed_[1].contains(shells)) at.reset();
    }
    if (at)
      throw Error(fmt::format(
          "crosses itself: its triangles {} and {} (from 0) meet near {}; accepted: triangles "
          "that touch at shared edges and corners only",
          soup_.numbers[k], soup_.numbers[l], soup_.place(*at)));
  }

 private:
  const Soup& soup_;
  Vec nudge_;  ///< of the shell that comes later  [m]
  std::set<std::pair<std::size_t, std::size_t>> crossed_[2];  ///< shells, moved along it or against
};

}  // namespace

void check_crossings(const Soup& soup, std::span<const Bounds> boxes, const OrderedBoxTree& tree) {
  Crossings crossings(soup);
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Vec centre = boxes[k].centre(), size = boxes[k].size();
    const auto apart = [&](const Vec& middle, const Vec& half) {
      const Vec off = middle - centre;
      return std::abs(off.x) > half.x + 0.5 * size.x || std::abs(off.y) > half.y + 0.5 * size.y ||
             std::abs(off.z) > half.z + 0.5 * size.z;
    };
    for_each_near(tree.tree, apart, [&](std::uint32_t i) {
      if (tree.order[i] > k) crossings.see(k, tree.order[i]);
    });
  }
}

}  // namespace airlight::closed_mesh
