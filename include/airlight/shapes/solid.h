#pragma once
#include <algorithm>
#include <memory>

#include "../closed_mesh.h"
#include "../pieces.h"
#include "../stretches.h"

namespace airlight::inline AIRLIGHT_ISA {

struct Medium;

/// A body of any form inside a watertight mesh, concave or with holes.
struct Solid {
  std::shared_ptr<const ClosedMesh> mesh;

  static constexpr auto name = "mesh";
  static constexpr auto meaning = "what a watertight mesh encloses, of any form";

  /// World coordinates about the mesh's centre.
  class Space;
  Space space() const noexcept;
};

/// Where one ray crosses a mesh, in double whatever the arithmetic around it.
class MeshCrossings {
 public:
  struct Crossing {
    double t;
    int turn;  ///< +1 out, −1 in
  };

  /// Along the whole line o + t d, in order.
  MeshCrossings(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d) noexcept;

  /// Calls add(t_enter, t_leave) for every stretch of the line inside the mesh, in order.
  template <class Add>
  void for_each_stretch(Add&& add) const noexcept {
    int depth = 0;
    double enter = 0;
    for (int i = 0; i < count_; ++i) {
      const int before = depth;
      depth -= crossings_[i].turn;
      if (before <= 0 && depth > 0) enter = crossings_[i].t;
      if (before > 0 && depth <= 0) add(enter, crossings_[i].t);
    }
  }

 private:
  int count_ = 0;
  Crossing crossings_[ClosedMesh::most_cut];
};

/// The section of a mesh by the plane through a ray and the direction to the light: signed lengths
/// of the way out along the ray, in double whatever the arithmetic around it. With t along the ray
/// and s along w, the plane cuts each triangle in a segment; light on its way out of p(t) leaves
/// the body there, or enters it again, so that
///
///     d(t) = Σ ± s(t)   over the segments above t with s(t) > 0,   + out, − in;
///
/// p(t) is inside where one more leads out than in.
class MeshSection {
 public:
  static constexpr int most_pieces = 2 * ClosedMesh::most_cut + 1;

  /// One piece of the ray, in which d is linear. Lengths count from t = 0.
  struct Piece {
    double t_begin, t_end;            ///< [m]
    double length_begin, length_end;  ///< of the whole way through the body  [m]
    bool inside;
  };

  /// Of o + t d, t in [0, t_max], with light from w.
  MeshSection(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d, Vec3<double> w, double t_max,
              const LightStart<double>& start = {}) noexcept;

  int count() const noexcept { return count_; }
  const Piece& operator[](int i) const noexcept { return pieces_[i]; }

 private:
  /// Where the plane cuts a triangle.
  struct Segment {
    double t0, t1, s0, s1;  ///< t0 < t1
    int turn;

    double s(double t) const noexcept {
      const double part = (t - t0) / (t1 - t0);
      return part * s1 + (1 - part) * s0;
    }
  };

  void cut(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d, Vec3<double> w, double sine,
           double t_max, const LightStart<double>& start) noexcept;
  /// Where a segment crosses the line a + b t.
  void add_crossing(const Segment& segment, double a, double b, double t_max) noexcept;
  void sweep(double t_max, const LightStart<double>& start) noexcept;
  void along_the_light(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d, bool into,
                       double t_max, const LightStart<double>& start) noexcept;

  int segment_count_ = 0, node_count_ = 0, count_ = 0;
  Segment segments_[ClosedMesh::most_cut];
  double nodes_[most_pieces];
  Piece pieces_[most_pieces];
};

inline MeshCrossings::MeshCrossings(const ClosedMesh& mesh, Vec3<double> o,
                                    Vec3<double> d) noexcept {
  // The line is where two planes through it meet.
  Vec3<double> e1, e2;
  orthonormal_basis(normalize(d), e1, e2);
  const double rounding = 1e-15 * length(d);  // of a line's side, over the sizes of the corners
  const auto misses = [&](Vec3<double> middle, Vec3<double> half) {
    const Vec3<double> q = middle - o;
    return std::abs(dot(e1, q)) > half_range(e1, half) ||
           std::abs(dot(e2, q)) > half_range(e2, half);
  };
  for_each_near(mesh.tree, misses, [&](std::uint32_t triangle) {
    const auto& corner = mesh.triangles[triangle];
    Vec3<double> p[3];
    double size[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = point_of(mesh.corners[corner[i]]) - o;
      size[i] = std::abs(p[i].x) + std::abs(p[i].y) + std::abs(p[i].z);
    }
    // On which side of each edge the line passes. An edge is always taken from its lower to its
    // upper corner, so that triangles that share it agree. Where the line meets it but for
    // rounding, as all edges of a corner that it starts at, the line counts as moved by next to
    // nothing along e1, and by next to nothing of that along e2.
    bool left[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const bool up = corner[i] < corner[j];
      const Vec3<double>&from = up ? p[i] : p[j], &to = up ? p[j] : p[i];
      double side = dot(d, cross(from, to));
      if (std::abs(side) <= rounding * size[i] * size[j]) side = dot(e2, from - to);
      if (side == 0) side = dot(e1, to - from);
      left[i] = up ? side >= 0 : side < 0;
    }
    const bool out = left[0] && left[1] && left[2], in = !left[0] && !left[1] && !left[2];
    if (!(out || in) || count_ == ClosedMesh::most_cut) return;
    const Vec3<double> normal = cross(p[1] - p[0], p[2] - p[0]);
    const double facing = dot(normal, d);
    if (facing != 0) crossings_[count_++] = {dot(normal, p[0]) / facing, out ? 1 : -1};
  });
  std::sort(crossings_, crossings_ + count_,
            [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
}

inline MeshSection::MeshSection(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d,
                                Vec3<double> w, double t_max,
                                const LightStart<double>& start) noexcept {
  if (!(t_max > 0)) {
    pieces_[count_++] = {0, 0, 0, 0, false};
    return;
  }
  const double sine = length(cross(d, w));
  // Closer to the light than this, its direction and the ray's count as one: d is off by no more
  // than the body's size times the sine.
  if (sine < 1e-8) {
    along_the_light(mesh, o, d, dot(d, w) > 0, t_max, start);
  } else {
    cut(mesh, o, d, w, sine, t_max, start);
    sweep(t_max, start);
  }
}

inline void MeshSection::cut(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d, Vec3<double> w,
                             double sine, double t_max, const LightStart<double>& start) noexcept {
  // p = o + t d + s w + r n.
  const Vec3<double> n = cross(d, w) * (1 / sine);
  const Vec3<double> t_of = cross(w, n) * (1 / sine), s_of = cross(n, d) * (1 / sine);
  const auto without_effect = [&](Vec3<double> middle, Vec3<double> half) {
    const Vec3<double> q = middle - o;
    const double t = dot(t_of, q), t_reach = half_range(t_of, half);
    return std::abs(dot(n, q)) > half_range(n, half) || t + t_reach < 0 || t - t_reach > t_max ||
           dot(s_of, q) + half_range(s_of, half) < 0;
  };
  for_each_near(mesh.tree, without_effect, [&](std::uint32_t triangle) {
    const auto& corner = mesh.triangles[triangle];
    Vec3<double> p[3];
    double r[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = point_of(mesh.corners[corner[i]]) - o;
      r[i] = dot(n, p[i]);
    }
    if ((r[0] >= 0) == (r[1] >= 0) && (r[1] >= 0) == (r[2] >= 0)) return;
    if (segment_count_ == ClosedMesh::most_cut) return;
    // The plane's way through the triangle, from where its outline goes below to where it comes up.
    double from_t = 0, from_s = 0, to_t = 0, to_s = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if ((r[i] >= 0) == (r[j] >= 0)) continue;
      // From the lower corner on, so that triangles that share the edge agree to the last bit.
      const int a = corner[i] < corner[j] ? i : j, b = a == i ? j : i;
      const double part = r[a] / (r[a] - r[b]);
      const Vec3<double> at = p[a] + (p[b] - p[a]) * part;
      (r[i] >= 0 ? from_t : to_t) = dot(t_of, at);
      (r[i] >= 0 ? from_s : to_s) = dot(s_of, at);
    }
    Segment segment{from_t, to_t, from_s, to_s, -1};
    if (to_t < from_t) segment = {to_t, from_t, to_s, from_s, 1};
    // Two nodes a segment at most: the ends of its part between the ray and where light starts.
    add_crossing(segment, start.a, start.b, t_max);
    if (from_t == to_t || (from_s <= 0 && to_s <= 0)) return;
    if (segment.t1 <= 0 || segment.t0 >= t_max) return;
    segments_[segment_count_++] = segment;
    for (const auto& [t, s] :
         {std::pair(segment.t0, segment.s0), std::pair(segment.t1, segment.s1)})
      if (s > 0 && s <= start(t) && t > 0 && t < t_max) nodes_[node_count_++] = t;
    add_crossing(segment, 0, 0, t_max);
  });
}

inline void MeshSection::add_crossing(const Segment& segment, double a, double b,
                                      double t_max) noexcept {
  const double before = segment.s0 - (a + b * segment.t0);
  const double after = segment.s1 - (a + b * segment.t1);
  if ((before > 0) == (after > 0)) return;
  const double t = segment.t0 + (segment.t1 - segment.t0) * (before / (before - after));
  if (t > 0 && t < t_max) nodes_[node_count_++] = t;
}

inline void MeshSection::sweep(double t_max, const LightStart<double>& start) noexcept {
  nodes_[node_count_++] = t_max;
  std::sort(nodes_, nodes_ + node_count_);
  std::sort(segments_, segments_ + segment_count_,
            [](const Segment& a, const Segment& b) { return a.t0 < b.t0; });
  const Segment* above[ClosedMesh::most_cut];  // or below: those over the piece at hand
  int above_count = 0, next = 0;
  double begin = 0, inside_so_far = 0;
  for (int i = 0; i < node_count_; ++i) {
    const double end = nodes_[i];
    if (!(end > begin)) continue;
    const double middle = 0.5 * (begin + end);
    while (next < segment_count_ && segments_[next].t0 < middle)
      above[above_count++] = &segments_[next++];
    Piece piece{begin, end, inside_so_far, inside_so_far, false};
    int depth = 0, depth_at_start = 0;
    for (int k = 0; k < above_count;) {
      const Segment& segment = *above[k];
      if (segment.t1 <= middle) {
        above[k] = above[--above_count];
        continue;
      }
      if (const double s = segment.s(middle); s > start(middle)) {
        depth_at_start += segment.turn;
      } else if (s > 0) {
        depth += segment.turn;
        piece.length_begin += segment.turn * std::max(segment.s(begin), 0.);
        piece.length_end += segment.turn * std::max(segment.s(end), 0.);
      }
      ++k;
    }
    if (depth_at_start > 0) piece.length_begin += start(begin), piece.length_end += start(end);
    piece.inside = depth + depth_at_start > 0;
    if (piece.inside) inside_so_far += end - begin, piece.length_end += end - begin;
    piece.length_begin = std::max(piece.length_begin, 0.);
    piece.length_end = std::max(piece.length_end, 0.);
    pieces_[count_++] = piece;
    begin = end;
  }
}

inline void MeshSection::along_the_light(const ClosedMesh& mesh, Vec3<double> o, Vec3<double> d,
                                         bool into, double t_max,
                                         const LightStart<double>& start) noexcept {
  const MeshCrossings crossings(mesh, o, d);
  double whole = 0, behind = 0;
  crossings.for_each_stretch([&](double enter, double leave) {
    // Only what lies on this side of where the light starts.
    if (into)
      leave = std::min(leave, start.a);
    else
      enter = std::max(enter, -start.a);
    whole += std::max(leave - enter, 0.);
    behind += std::max(std::min(leave, 0.) - enter, 0.);
  });
  // Towards the light, what lies ahead is passed whether before p(t) or after it. Away from it,
  // what lies behind is passed twice.
  double begin = 0, so_far = 0;
  const auto add = [&](double end, bool inside) {
    end = std::clamp(end, begin, t_max);
    if (!(end > begin)) return;
    const double step = inside ? end - begin : 0;
    const double first = into ? whole - behind : behind + 2 * so_far;
    pieces_[count_++] = {begin, end, first, into ? first : first + 2 * step, inside};
    so_far += step;
    begin = end;
  };
  crossings.for_each_stretch([&](double enter, double leave) {
    add(enter, false);
    add(leave, true);
  });
  add(t_max, false);
}

class Solid::Space {
 public:
  static constexpr bool in_pieces = true, one_medium = true;
  static constexpr int most_stretches = (ClosedMesh::most_cut + 1) / 2;
  static constexpr int most_pieces = MeshSection::most_pieces;

  explicit Space(const ClosedMesh& mesh) noexcept : mesh_(&mesh), centre_(point_of(mesh.centre)) {}

  template <Real F>
  Vec3<F> point(Vec3<F> p) const noexcept {
    return p - Vec3<F>(centre_);
  }
  template <Real F>
  Vec3<F> vector(Vec3<F> v) const noexcept {
    return v;
  }

  /// From the first entry to the last exit.
  template <Real F>
  Interval<F> clip(const LocalRay<F>& ray) const noexcept {
    alignas(64) Scalar<F> enter[lanes<F>], leave[lanes<F>];
    for (int i = 0; i < lanes<F>; ++i) {
      enter[i] = Scalar<F>(far_away), leave[i] = 0;
      for_each_stretch_ahead(lane_of(ray, i), [&](double from, double to) {
        enter[i] = std::min(enter[i], Scalar<F>(from));
        leave[i] = Scalar<F>(to);
      });
    }
    return {load<F>(enter), load<F>(leave)};
  }

  template <Real F>
  using StretchesOf = Stretches<F, most_stretches, Medium>;

  template <Real F>
  StretchesOf<F> stretches(const LocalRay<F>& ray, const Medium& medium) const noexcept {
    StretchesOf<F> result;
    result.media = &medium;
    int counts[lanes<F>] = {};
    for (int i = 0; i < lanes<F>; ++i)
      for_each_stretch_ahead(lane_of(ray, i), [&](double from, double to) {
        const int k = counts[i]++;
        if (k == result.count) result.add({F(0), F(0)});
        scalars_of(result.enter + k)[i] = Scalar<F>(from);
        scalars_of(result.leave + k)[i] = Scalar<F>(to);
      });
    return result;
  }

  template <Real F, int channels>
  using PiecesOf = Pieces<F, channels, 1, most_pieces>;

  template <int channels, Real F>
  void cut(const LocalRay<F>& ray, Vec3<F> w, F t_max, const StretchesOf<F>& inside,
           PiecesOf<F, channels>& pieces, const LightStart<F>& start = {}) const noexcept {
    set_scale(pieces, inside, dot(w, ray.d));
    const F zero(0);
    pieces.t[0] = zero;
    for (int i = 0; i < lanes<F>; ++i) {
      const LocalRay<double> one = lane_of(ray, i);
      const MeshSection section(*mesh_, one.o, one.d, lane_of(w, i), double(lane(t_max, i)),
                                {double(lane(start.a, i)), double(lane(start.b, i))});
      for (int k = 0; k < section.count(); ++k) {
        if (k == pieces.count) {
          // Lanes that are through already go on with pieces of no length.
          pieces.add(pieces.t[k], {zero}, {zero}, {zero});
        }
        const MeshSection::Piece& piece = section[k];
        scalars_of(pieces.t + k + 1)[i] = Scalar<F>(piece.t_end);
        scalars_of(&pieces.begin[k][0])[i] = Scalar<F>(piece.length_begin);
        scalars_of(&pieces.end[k][0])[i] = Scalar<F>(piece.length_end);
        scalars_of(&pieces.strength[k][0])[i] = Scalar<F>(piece.inside ? 1 : 0);
      }
      for (int k = section.count(); k < pieces.count; ++k)
        scalars_of(pieces.t + k + 1)[i] = scalars_of(pieces.t + k)[i];
    }
  }

  /// s and τ at one point of the ray for light from w, without the pieces.
  template <int channels, Real F>
  typename PiecesOf<F, channels>::Point seen(const LocalRay<F>& ray, F t, Vec3<F> w,
                                             const StretchesOf<F>& inside,
                                             const LightStart<F>& start = {}) const noexcept {
    const auto& medium = inside.medium(0);
    const Rgb<F> depth =
        inside.depth(t) + stretches(LocalRay<F>{ray(t), w}, medium).depth(start(t));
    Mask<F> here = t < F(0);
    for (int j = 0; j < inside.count; ++j) here = here | inside.holds(j, t);
    const F phase = select(here, evaluate(medium.phase, dot(w, ray.d)), F(0));
    typename PiecesOf<F, channels>::Point result;
    for (int c = 0; c < channels; ++c) {
      result.depth[c] = depth[c];
      result.strength[c] = F(Scalar<F>(medium.sigma_s[c])) * phase;
    }
    return result;
  }

  /// One medium fills the body: pieces hold lengths.
  template <Real F, class Cut>
  static void set_scale(Cut& pieces, const StretchesOf<F>& inside, F cosine) noexcept {
    const auto& medium = inside.medium(0);
    const F phase = evaluate(medium.phase, cosine);
    for (int c = 0; c < int(pieces.sigma_t.size()); ++c) {
      pieces.sigma_t[c] = F(Scalar<F>(medium.sigma_t[c]));
      pieces.sigma_s[c] = F(Scalar<F>(medium.sigma_s[c])) * phase;
    }
  }

 private:
  template <Real F>
  static Vec3<double> lane_of(const Vec3<F>& v, int i) noexcept {
    return {double(lane(v.x, i)), double(lane(v.y, i)), double(lane(v.z, i))};
  }
  template <Real F>
  static LocalRay<double> lane_of(const LocalRay<F>& ray, int i) noexcept {
    return {lane_of(ray.o, i), lane_of(ray.d, i)};
  }

  template <class Add>
  void for_each_stretch_ahead(const LocalRay<double>& ray, Add&& add) const noexcept {
    MeshCrossings(*mesh_, ray.o, ray.d).for_each_stretch([&](double enter, double leave) {
      if (leave > 0) add(std::max(enter, 0.), leave);
    });
  }

  const ClosedMesh* mesh_;
  Vec3<double> centre_;
};

inline Solid::Space Solid::space() const noexcept { return Space(*mesh); }

}  // namespace airlight::inline AIRLIGHT_ISA
