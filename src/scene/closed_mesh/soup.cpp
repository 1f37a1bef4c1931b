#include "scene/closed_mesh/soup.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "error.h"
#include "scene/bounds.h"

namespace airlight::closed_mesh {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

void flip(Triangle& t) { std::swap(t[1], t[2]); }

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

}  // namespace

std::string Soup::place(const Vec& p) const {
  const Vec q = p + centre;
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", q.x, q.y, q.z);
}

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
                      "accepted: 2 at every edge",
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

}  // namespace airlight::closed_mesh
