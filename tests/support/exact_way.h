#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace airlight::test {

/// What judges the core's doubles.
using Exact = long double;
using Point = std::array<Exact, 3>;

inline Exact dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point along(const Point& o, const Point& d, Exact t) {
  return {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
}

/// {x : n·x ≤ h}.
struct HalfSpace {
  Point n;
  Exact h;
};
using Body = std::vector<HalfSpace>;

/// Whether a point lies in every half-space, or at most `slack` outside.
inline bool is_inside(const Body& body, const Point& p, Exact slack = 0) {
  return std::ranges::all_of(
      body, [&](const HalfSpace& face) { return dot(face.n, p) <= face.h + slack; });
}

/// [lo, hi] from its six faces.
inline Body box_body(const Point& lo = {-1, -1, -1}, const Point& hi = {1, 1, 1}) {
  Body body;
  for (int k = 0; k < 3; ++k) {
    Point up{}, down{};
    up[k] = 1, down[k] = -1;
    body.push_back({up, hi[k]});
    body.push_back({down, -lo[k]});
  }
  return body;
}

/// The distance from p along w to the boundary, face by face. Faces with n·w at or below
/// `parallel_below` are never met.
inline Exact exact_distance_out(const Body& body, const Point& p, const Point& w,
                                Exact parallel_below = 0) {
  Exact distance = std::numeric_limits<Exact>::infinity();
  for (const HalfSpace& face : body)
    if (const Exact facing = dot(face.n, w); facing > parallel_below)
      distance = std::min(distance, (face.h - dot(face.n, p)) / facing);
  return std::max<Exact>(distance, 0);
}

/// The way o + t d, t in [0, t_max], and on along w out of a convex body, by brute force: its kinks
/// are sought among the crossings of all pairs of faces, and every length is measured afresh at its
/// point. Shares no code and no idea with the library but the trapezoid; quadrature judges it in
/// its turn.
class ExactWay {
 public:
  ExactWay(Body body, const Point& o, const Point& d, const Point& w, Exact t_max,
           Exact parallel_below = 0)
      : body_(std::move(body)),
        o_(o),
        d_(d),
        w_(w),
        t_max_(t_max),
        parallel_below_(parallel_below) {
    std::vector<std::array<Exact, 2>>
        lines;  // distance out through a face: at t = 0, and its slope
    for (const HalfSpace& face : body_)
      if (const Exact facing = dot(face.n, w); facing > parallel_below)
        lines.push_back({(face.h - dot(face.n, o)) / facing, -dot(face.n, d) / facing});
    nodes_ = {0, t_max};
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Exact t = (lines[i][0] - lines[j][0]) / (lines[j][1] - lines[i][1]);
        if (t > 0 && t < t_max) nodes_.push_back(t);
      }
    std::ranges::sort(nodes_);
  }

  Exact t_max() const { return t_max_; }

  /// t + the distance out from there.
  Exact length(Exact t) const {
    return t + exact_distance_out(body_, along(o_, d_, t), w_, parallel_below_);
  }

  /// The smallest length, at one of the ends.
  Exact shortest() const { return std::min(length(0), length(t_max_)); }
  Exact longest() const {
    Exact l = 0;
    for (Exact t : nodes_) l = std::max(l, length(t));
    return l;
  }

  /// ∫ e^{−σ (length − shortest)} dt over [from, to].
  Exact integral(Exact sigma, Exact from, Exact to) const {
    const Exact base = shortest();
    std::vector<Exact> t = {from};
    for (Exact node : nodes_)
      if (node > from && node < to) t.push_back(node);
    t.push_back(to);
    Exact sum = 0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      const Exact x = sigma * (length(t[i - 1]) - base), y = sigma * (length(t[i]) - base);
      const Exact rise = std::abs(y - x);
      sum += (t[i] - t[i - 1]) * std::exp(-std::min(x, y)) *
             (rise > 0 ? -std::expm1(-rise) / rise : Exact(1));
    }
    return sum;
  }
  Exact integral(Exact sigma) const { return integral(sigma, 0, t_max_); }

 private:
  Body body_;
  Point o_, d_, w_;
  Exact t_max_, parallel_below_;
  std::vector<Exact> nodes_;
};

}  // namespace airlight::test
