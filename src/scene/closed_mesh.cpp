#include "scene/closed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "error.h"
#include "scene/bounds.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;
using Triangle = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// What is to become a body.
struct Soup {
  std::vector<Vec> corners;  ///< about `centre`
  std::vector<Triangle> triangles;
  std::vector<std::size_t> numbers;     ///< of the triangles in the file, from 0
  std::vector<std::size_t> components;  ///< of the triangles
  std::size_t component_count = 0;
  Vec centre;
  double size = 0;  ///< the largest distance of a corner from the centre

  const Vec& corner(std::size_t triangle, int i) const {
    return corners[triangles[triangle][std::size_t(i % 3)]];
  }
  std::string place(const Vec& p) const {
    const Vec q = p + centre;
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", q.x, q.y, q.z);
  }
};

/// Corners at the same place become one, about the middle of all.
Soup welded(std::span<const ClosedMesh::Point> points, std::span<const Triangle> triangles) {
  Soup soup;
  std::map<ClosedMesh::Point, std::uint32_t> places;
  std::vector<std::uint32_t> place_of;
  for (const ClosedMesh::Point& p : points) {
    const auto [at, is_new] = places.try_emplace(p, std::uint32_t(places.size()));
    if (is_new) soup.corners.push_back({p[0], p[1], p[2]});
    place_of.push_back(at->second);
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& [a, b, c] = triangles[k];
    const Triangle t = {place_of[a], place_of[b], place_of[c]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;  // no area, and no edge left open
    soup.triangles.push_back(t);
    soup.numbers.push_back(k);
  }
  if (soup.triangles.empty()) throw Error("encloses nothing: it has no triangles");
  Bounds bounds;
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t i : t) bounds.extend(soup.corners[i]);
  soup.centre = bounds.centre();
  soup.size = length(bounds.size()) / 2;
  for (Vec& p : soup.corners) p = p - soup.centre;
  return soup;
}

void flip(Triangle& t) { std::swap(t[1], t[2]); }

/// Turns neighbours to the same side and finds what hangs together.
void connect(Soup& soup) {
  struct Side {
    std::size_t triangle;
    bool forwards;
  };
  std::map<Edge, std::vector<Side>> edges;
  const auto edge_of = [&](std::size_t k, int i) {
    const std::uint32_t a = soup.triangles[k][std::size_t(i)];
    const std::uint32_t b = soup.triangles[k][std::size_t((i + 1) % 3)];
    return std::pair(Edge(std::min(a, b), std::max(a, b)), a < b);
  };
  for (std::size_t k = 0; k < soup.triangles.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const auto [edge, forwards] = edge_of(k, i);
      edges[edge].push_back({k, forwards});
    }
  for (const auto& [edge, sides] : edges)
    if (sides.size() != 2)
      throw Error(
          fmt::format("is no closed body: its edge from {} to {} belongs to {} triangle{}; "
                      "accepted: 2 at every "
                      "edge",
                      soup.place(soup.corners[edge.first]), soup.place(soup.corners[edge.second]),
                      sides.size(), sides.size() == 1 ? "" : "s"));

  constexpr std::size_t none = std::size_t(-1);
  soup.components.assign(soup.triangles.size(), none);
  std::vector<bool> turned(soup.triangles.size());
  for (std::size_t first = 0; first < soup.triangles.size(); ++first) {
    if (soup.components[first] != none) continue;
    std::vector<std::size_t> open = {first};
    soup.components[first] = soup.component_count;
    while (!open.empty()) {
      const std::size_t k = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const auto& sides = edges[edge_of(k, i).first];
        const Side& mine = sides[sides[0].triangle == k ? 0 : 1];
        const Side& other = sides[sides[0].triangle == k ? 1 : 0];
        const bool turn = (mine.forwards == other.forwards) != turned[k];
        if (soup.components[other.triangle] == none) {
          soup.components[other.triangle] = soup.component_count;
          turned[other.triangle] = turn;
          open.push_back(other.triangle);
        } else if (turned[other.triangle] != turn) {
          throw Error(
              fmt::format("has one side only, seen from {}; accepted: an inside and an "
                          "outside",
                          soup.place(soup.corner(k, i))));
        }
      }
    }
    ++soup.component_count;
  }
  for (std::size_t k = 0; k < turned.size(); ++k)
    if (turned[k]) flip(soup.triangles[k]);
}

/// A ray from p crosses the triangle: +1 out, -1 in, as its corners go round; else 0.
int crossing(const Soup& soup, std::size_t k, const Vec& p, const Vec& d) {
  bool left[3];
  for (int i = 0; i < 3; ++i) {
    const Vec a = soup.corner(k, i) - p, b = soup.corner(k, i + 1) - p;
    const bool up = soup.triangles[k][std::size_t(i)] < soup.triangles[k][std::size_t((i + 1) % 3)];
    const double side = dot(d, cross(up ? a : b, up ? b : a));
    left[i] = up ? side >= 0 : side < 0;
  }
  const bool out = left[0] && left[1] && left[2], in = !left[0] && !left[1] && !left[2];
  if (!out && !in) return 0;
  const Vec normal =
      cross(soup.corner(k, 1) - soup.corner(k, 0), soup.corner(k, 2) - soup.corner(k, 0));
  const double facing = dot(normal, d);
  if (facing == 0 || !(dot(normal, soup.corner(k, 0) - p) / facing > 0)) return 0;
  return out ? 1 : -1;
}

/// Shells turn their outside to where the medium is not: every second one of those inside each
/// other.
void turn_out(Soup& soup) {
  std::vector<double> volumes(soup.component_count);
  std::vector<std::size_t> firsts(soup.component_count, soup.triangles.size());
  for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
    volumes[soup.components[k]] +=
        dot(soup.corner(k, 0), cross(soup.corner(k, 1), soup.corner(k, 2)));
    firsts[soup.components[k]] = std::min(firsts[soup.components[k]], k);
  }
  std::vector<bool> inward(soup.component_count);
  for (std::size_t c = 0; c < soup.component_count; ++c) {
    const Vec from = soup.corner(firsts[c], 0);
    const Vec d = normalize(Vec(0.5773, 0.2137, 0.7891));
    int shells = 0;
    for (std::size_t k = 0; k < soup.triangles.size(); ++k)
      if (soup.components[k] != c) shells += crossing(soup, k, from, d) != 0;
    inward[c] = (shells % 2 == 1) != (volumes[c] < 0);
  }
  for (std::size_t k = 0; k < soup.triangles.size(); ++k)
    if (inward[soup.components[k]]) flip(soup.triangles[k]);
}

Bounds bounds_of(const Soup& soup, std::size_t k) {
  Bounds bounds;
  for (int i = 0; i < 3; ++i) bounds.extend(soup.corner(k, i));
  return bounds;
}

bool meet(const Bounds& bounds, const ClosedMesh::Node& node) {
  for (std::size_t i = 0; i < 3; ++i)
    if (bounds.min[int(i)] > node.middle[i] + node.half[i] ||
        bounds.max[int(i)] < node.middle[i] - node.half[i])
      return false;
  return true;
}

/// The tree over order[first] to order[end − 1], halved across its longest side.
void grow(const Soup& soup, std::vector<std::size_t>& order, std::size_t first, std::size_t end,
          std::vector<ClosedMesh::Node>& tree) {
  constexpr std::size_t leaf = 4;
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
  const std::size_t node = tree.size();
  tree.push_back({{middle.x, middle.y, middle.z}, {half.x, half.y, half.z}, 0, 0, 0});
  if (end - first <= leaf) {
    tree[node].first = std::uint32_t(first);
    tree[node].count = std::uint32_t(end - first);
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
    grow(soup, order, first, half_way, tree);
    grow(soup, order, half_way, end, tree);
  }
  tree[node].next = std::uint32_t(tree.size());
}

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

void check_crossings(const Soup& soup, const std::vector<std::size_t>& order,
                     const std::vector<ClosedMesh::Node>& tree) {
  Crossings crossings(soup);
  for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
    const Bounds bounds = bounds_of(soup, k);
    for (std::size_t n = 0; n < tree.size();) {
      const ClosedMesh::Node& node = tree[n];
      if (!meet(bounds, node)) {
        n = node.next;
        continue;
      }
      for (std::size_t i = node.first; i < node.first + node.count; ++i)
        if (order[i] > k) crossings.see(k, order[i]);
      ++n;
    }
  }
}

/// Proves that no plane cuts more triangles than a ray has room for, by branch and bound over the
/// planes' normals: over a cell of them, a triangle covers an interval of offsets, and where most
/// intervals overlap is a bound on what any plane of the cell cuts.
class CutBound {
 public:
  explicit CutBound(const Soup& soup) : soup_(soup) {}

  void prove() {
    if (soup_.triangles.size() <= ClosedMesh::most_cut) return;
    for (int face = 0; face < 3; ++face) prove(face, {-1, 1}, {-1, 1}, 0);
  }

 private:
  using Range = std::pair<double, double>;

  /// Normals through a rectangle on one face of the cube around the origin; opposite ones are
  /// alike.
  void prove(int face, Range u, Range v, int depth) {
    constexpr int deepest = 8;
    const auto normal = [&](double x, double y) {
      const Vec n = face == 0 ? Vec(1, x, y) : face == 1 ? Vec(y, 1, x) : Vec(x, y, 1);
      return normalize(n);
    };
    const double middle_u = (u.first + u.second) / 2, middle_v = (v.first + v.second) / 2;
    const Vec n = normal(middle_u, middle_v);
    double chord = 0;  // how far a normal of the cell may be from the middle one
    for (const double x : {u.first, u.second})
      for (const double y : {v.first, v.second}) chord = std::max(chord, length(normal(x, y) - n));
    const std::size_t cut = most_cut(n, chord);
    if (cut <= ClosedMesh::most_cut) return;
    if (depth == deepest)
      throw Error(
          fmt::format("is too intricate: a plane may cut {} of its {} triangles; accepted "
                      "are up to {} at once",
                      cut, soup_.triangles.size(), ClosedMesh::most_cut));
    for (const Range& x : {Range(u.first, middle_u), Range(middle_u, u.second)})
      for (const Range& y : {Range(v.first, middle_v), Range(middle_v, v.second)})
        prove(face, x, y, depth + 1);
  }

  std::size_t most_cut(const Vec& n, double chord) {
    low_.clear(), high_.clear();
    for (std::size_t k = 0; k < soup_.triangles.size(); ++k) {
      double low = 1e300, high = -1e300;
      for (int i = 0; i < 3; ++i) {
        const Vec& p = soup_.corner(k, i);
        const double offset = dot(n, p), spread = chord * length(p);
        low = std::min(low, offset - spread), high = std::max(high, offset + spread);
      }
      low_.push_back(low), high_.push_back(high);
    }
    std::ranges::sort(low_);
    std::ranges::sort(high_);
    std::size_t most = 0, ended = 0;
    for (std::size_t begun = 0; begun < low_.size(); ++begun) {
      while (high_[ended] < low_[begun]) ++ended;
      most = std::max(most, begun + 1 - ended);
    }
    return most;
  }

  const Soup& soup_;
  std::vector<double> low_, high_;
};

}  // namespace

std::shared_ptr<const ClosedMesh> close_mesh(std::span<const ClosedMesh::Point> points,
                                             std::span<const Triangle> triangles) {
  Soup soup = welded(points, triangles);
  connect(soup);
  turn_out(soup);
  std::vector<std::size_t> order(soup.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto mesh = std::make_shared<ClosedMesh>();
  grow(soup, order, 0, order.size(), mesh->tree);
  check_crossings(soup, order, mesh->tree);
  CutBound(soup).prove();
  for (const Vec& p : soup.corners) mesh->corners.push_back({p.x, p.y, p.z});
  for (const std::size_t k : order) mesh->triangles.push_back(soup.triangles[k]);
  mesh->centre = {soup.centre.x, soup.centre.y, soup.centre.z};
  return mesh;
}

}  // namespace airlight
