#include "scene/closed_mesh/cut_bound.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace airlight::closed_mesh {
namespace {

/// Branch and bound over the planes' normals: over a cell of them, a triangle covers an interval of
/// offsets, and where most intervals overlap is a bound on what any plane of the cell cuts.
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

void check_cuts(const Soup& soup) { CutBound(soup).prove(); }

}  // namespace airlight::closed_mesh
