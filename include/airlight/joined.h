#pragma once
#include <span>

#include "math/sort.h"
#include "medium.h"
#include "pieces.h"
#include "stretches.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Several media side by side: a union of convex bodies that do not overlap, each with its own
/// coefficients. Light from w may leave one and cross others on its way out, so the optical depth
/// of the whole way is a sum over the bodies,
///
///     τ(t) = Σ_j σ_j |[0, t] ∩ I_j| + Σ_j σ_j max(0, exit_j(t) − max(0, entry_j(t)))
///
/// I_j the part of the ray in body j; exit_j the lowest of the lines (distance along w to a face)
/// of the faces that light from w enters by, entry_j the highest of those of the other faces. Where
/// a face is parallel to w it bounds the t that light through body j meets, and τ jumps there.
class Joined {
 public:
  static constexpr int most_parts = 16;
  static constexpr int most_faces = 96;
  /// A body of n faces makes at most 2 n + 4 kinks: n − 1 of exit and as many of entry (of a packet
  /// whose lanes differ in w; n − 2 together if they don't), and two each where the line along w
  /// leaves the body's outline, where entry changes sign and at faces parallel to w; one more where
  /// the light starts at a plane.
  static constexpr int most_kinks = 2 * most_faces + 5 * most_parts;
  static constexpr int most_pieces = most_kinks + 1;
  static constexpr int most_stretches = most_parts;
  static constexpr bool in_pieces = true, one_medium = false;

  /// Whether there is room for these media and all are boxes or convex polyhedra. Whether they
  /// overlap is not looked at.
  static bool fits(std::span<const Medium> media) noexcept {
    int faces = 0;
    for (const Medium& medium : media) {
      const int own = face_count(medium.shape);
      if (own == 0) return false;
      faces += own;
    }
    return media.size() <= most_parts && faces <= most_faces;
  }

  /// Media that fit; of others those before the first that has no room.
  explicit Joined(std::span<const Medium> media) noexcept : media_(media.data()) {
    while (!fits(media)) media = media.first(media.size() - 1);
    for (const Medium& medium : media) {
      const Convex body = as_convex(medium.shape);
      centre_ = centre_ + body.centre * (1. / double(media.size()));
    }
    for (const Medium& medium : media) {
      const Convex body = as_convex(medium.shape);
      Part& part = parts_[part_count_++];
      part.first = part_count_ == 1 ? 0 : parts_[part_count_ - 2].end;
      part.end = part.first + body.face_count;
      for (int k = 0; k < body.face_count; ++k)
        faces_[part.first + k] = {body.faces[k].n, body.faces[k].h - dot(body.faces[k].n, centre_)};
    }
  }

  /// Of a box or a polyhedron; 0 of any other shape.
  static int face_count(const Shapes& shape) noexcept {
    if (const auto* convex = std::get_if<Convex>(&shape)) return convex->face_count;
    return std::holds_alternative<Box>(shape) ? 6 : 0;
  }

  /// A box or a polyhedron as its faces; an unbounded medium has none.
  static Convex as_convex(const Shapes& shape) noexcept {
    if (const auto* convex = std::get_if<Convex>(&shape)) return *convex;
    Convex result;
    if (const auto* box = std::get_if<Box>(&shape)) {
      const Box::Space space = box->space();
      result.centre = space.centre;
      for (const Vec3<double>& row : space.rows)
        for (const double side : {1., -1.}) {
          const double scale = 1 / length(row);
          const Vec3<double> n = row * (side * scale);
          result.faces[result.face_count++] = {n, dot(n, space.centre) + scale};
        }
    }
    return result;
  }

  template <Real F>
  Vec3<F> point(Vec3<F> p) const noexcept {
    return p - Vec3<F>(centre_);
  }
  template <Real F>
  Vec3<F> vector(Vec3<F> v) const noexcept {
    return v;
  }

  /// Whether all channels of all media are alike.
  bool is_grey() const noexcept {
    for (int j = 0; j < part_count_; ++j) {
      const Rgb<double>& s = media_[j].sigma_s;
      if (!media_[j].is_grey() || s.r != s.g || s.g != s.b) return false;
    }
    return true;
  }

  /// From the first entry to the last exit.
  template <Real F>
  Interval<F> clip(const LocalRay<F>& ray) const noexcept {
    return stretches(ray, media_[0]).hull();
  }

  template <Real F>
  using StretchesOf = Stretches<F, most_stretches, Medium>;

  template <Real F>
  StretchesOf<F> stretches(const LocalRay<F>& ray, const Medium&) const noexcept {
    StretchesOf<F> result;
    result.media = media_, result.each_own = 1;
    for (int j = 0; j < part_count_; ++j) result.add(clip(parts_[j], ray));
    return result;
  }

  template <Real F, int channels>
  using PiecesOf = Pieces<F, channels, channels, most_pieces>;

  /// Cuts [0, t_max] of the ray where the optical depth of the whole way has a kink or a jump.
  /// `inside` are the ray's own stretches; light travels against w.
  template <int channels, Real F>
  void cut(const LocalRay<F>& ray, Vec3<F> w, F t_max, const StretchesOf<F>& inside,
           PiecesOf<F, channels>& pieces, const LightStart<F>& start = {}) const noexcept {
    const Lines<F> lines(*this, ray, w, t_max, start);
    F kinks[most_kinks];
    const int n = lines.kinks(kinks);
    sort_lanes(kinks, n);
    set_scale(pieces, inside, F(0));
    pieces.t[0] = F(0);
    const F cosine = dot(w, ray.d);
    F scatters[most_parts];
    for (int j = 0; j < part_count_; ++j) scatters[j] = evaluate(media_[j].phase, cosine);
    for (int i = 0; i <= n; ++i) {
      const F t0 = pieces.t[pieces.count];
      const F t1 = i < n ? clamp(kinks[i], t0, t_max) : t_max;
      if (!any(t1 > t0) && !(pieces.count == 0 && i == n)) continue;
      // τ is linear here but jumps at the ends: it is read inside and prolonged.
      const F quarter = fma(t1 - t0, F(0.25), t0), rest = fma(t1 - t0, F(0.75), t0);
      const F middle = fma(t1 - t0, F(0.5), t0);
      std::array<F, channels> from{}, to{}, strength{};
      for (int j = 0; j < part_count_; ++j) {
        F near = inside.length_before(j, t0), far = inside.length_before(j, t1);
        if (lines.meets(j)) {
          const F a = lines.length(j, quarter), b = lines.length(j, rest);
          near = near + max(F(1.5) * a - F(0.5) * b, F(0));
          far = far + max(F(1.5) * b - F(0.5) * a, F(0));
        }
        const F here = select(inside.holds(j, middle), scatters[j], F(0));
        for (int c = 0; c < channels; ++c) {
          const F sigma(Scalar<F>(media_[j].sigma_t[c]));
          from[c] = fma(sigma, near, from[c]);
          to[c] = fma(sigma, far, to[c]);
          strength[c] = fma(F(Scalar<F>(media_[j].sigma_s[c])), here, strength[c]);
        }
      }
      pieces.add(t1, from, to, strength);
    }
  }

  /// s and τ at one point of the ray for light from w, without the pieces.
  template <int channels, Real F>
  typename PiecesOf<F, channels>::Point seen(const LocalRay<F>& ray, F t, Vec3<F> w,
                                             const StretchesOf<F>& inside,
                                             const LightStart<F>& start = {}) const noexcept {
    typename PiecesOf<F, channels>::Point result{};
    const F cosine = dot(w, ray.d);
    const LocalRay<F> out{ray(t), w};
    for (int j = 0; j < part_count_; ++j) {
      const Interval<F> beyond = clip(parts_[j], out);
      const F way =
          inside.length_before(j, t) + max(min(beyond.t_exit, start(t)) - beyond.t_enter, F(0));
      const F here = select(inside.holds(j, t), evaluate(media_[j].phase, cosine), F(0));
      for (int c = 0; c < channels; ++c) {
        result.depth[c] = fma(F(Scalar<F>(media_[j].sigma_t[c])), way, result.depth[c]);
        result.strength[c] = fma(F(Scalar<F>(media_[j].sigma_s[c])), here, result.strength[c]);
      }
    }
    return result;
  }

  /// Every medium has coefficients of its own: pieces hold depths themselves.
  template <Real F, class Cut>
  static void set_scale(Cut& pieces, const StretchesOf<F>&, F) noexcept {
    for (F& sigma : pieces.sigma_t) sigma = F(1);
    for (F& sigma : pieces.sigma_s) sigma = F(1);
  }

 private:
  /// A body: its faces are faces_[first] to faces_[end − 1].
  struct Part {
    int first = 0, end = 0;
  };

  template <Real F>
  Interval<F> clip(const Part& part, const LocalRay<F>& ray) const noexcept {
    return clip_by_planes(std::span(faces_).subspan(part.first, part.end - part.first), ray);
  }

  /// The distances along w from points of a ray to the planes of every body, as lines a + b t.
  template <Real F>
  class Lines {
   public:
    Lines(const Joined& joined, const LocalRay<F>& ray, Vec3<F> w, F t_max,
          const LightStart<F>& start) noexcept
        : joined_(joined), t_max_(t_max) {
      const F least = F(parallel_below<F>) * airlight::length(w);
      int fronts = 0, backs = 0;
      for (int j = 0; j < joined.part_count_; ++j) {
        Range& range = ranges_[j];
        range.front = fronts, range.back = backs;
        F from(0), to = t_max;
        for (int k = joined.parts_[j].first; k < joined.parts_[j].end; ++k) {
          const Plane& face = joined.faces_[k];
          const Vec3<F> n(face.n);
          const F facing = dot(n, w), above = F(Scalar<F>(face.h)) - dot(n, ray.o);
          const F climb = dot(n, ray.d);
          const Mask<F> is_front = facing > least, is_back = facing < -least;
          const F inverse = F(1) / select(is_front | is_back, facing, F(1));
          const F a = above * inverse, b = -climb * inverse;
          if (any(is_front))
            front_[fronts++] = {select(is_front, a, F(far_away)), select(is_front, b, F(0))};
          if (any(is_back))
            back_[backs++] = {select(is_back, a, F(-far_away)), select(is_back, b, F(0))};
          const Mask<F> parallel = !(is_front | is_back);
          if (any(parallel)) keep_below(above, climb, parallel, from, to);
        }
        if (any(start.a < F(far_away))) front_[fronts++] = {start.a, start.b};
        range.front_end = fronts, range.back_end = backs;
        range.from = from, range.to = to;
        // Where the line along w through p(t) meets the body, ahead of p(t).
        for (int i = range.front; i < range.front_end; ++i) {
          keep_below(front_[i].a, -front_[i].b, front_[i].a < F(far_away), from, to);
          for (int k = range.back; k < range.back_end; ++k)
            keep_below(front_[i].a - back_[k].a, back_[k].b - front_[i].b, all_lanes(), from, to);
        }
        range.meets_from = from, range.meets_to = to;
        range.meets = any(to > from);
      }
    }

    /// Whether any lane's light crosses body j.
    bool meets(int j) const noexcept { return ranges_[j].meets; }

    /// How much of body j lies on the way from p(t) along w.  [m]
    F length(int j, F t) const noexcept {
      const Range& range = ranges_[j];
      F exit(far_away), entry(0);
      for (int i = range.front; i < range.front_end; ++i)
        exit = min(exit, fma(front_[i].b, t, front_[i].a));
      for (int i = range.back; i < range.back_end; ++i)
        entry = max(entry, fma(back_[i].b, t, back_[i].a));
      const Mask<F> within = (t >= range.from) & (t <= range.to);
      return select(within, max(exit - entry, F(0)), F(0));
    }

    /// Every t in (0, t_max) where τ may have a kink or jump; how many.
    int kinks(F* kinks) const noexcept {
      int n = 0;
      for (int j = 0; j < joined_.part_count_; ++j) {
        const Range& range = ranges_[j];
        if (!range.meets) continue;
        n = add(range.meets_from, kinks, n), n = add(range.meets_to, kinks, n);
        n = add(range.from, kinks, n), n = add(range.to, kinks, n);
        n = envelope(front_ + range.front, range.front_end - range.front, false, kinks, n);
        n = envelope(back_ + range.back, range.back_end - range.back, true, kinks, n);
        // Where p(t) itself passes the body's back.
        F from(0), to = t_max_;
        for (int k = range.back; k < range.back_end; ++k)
          keep_below(-back_[k].a, back_[k].b, back_[k].a > F(-far_away), from, to);
        n = add(from, kinks, n), n = add(to, kinks, n);
      }
      return n;
    }

   private:
    struct Line {
      F a, b;
    };
    struct Range {
      int front, front_end, back, back_end;
      F from, to;              ///< between the faces parallel to w
      F meets_from, meets_to;  ///< where light crosses the body
      bool meets;
    };

    static Mask<F> all_lanes() noexcept { return F(0) < F(1); }

    /// Shrinks [from, to] to where climb · t <= above, in some lanes.
    static void keep_below(F above, F climb, Mask<F> lanes_, F& from, F& to) noexcept {
      const Mask<F> rises = lanes_ & (climb > F(0)), falls = lanes_ & (climb < F(0));
      const F t = above / select(rises | falls, climb, F(1));
      to = select(rises, min(to, t), to);
      from = select(falls, max(from, t), from);
      const Mask<F> never = lanes_ & !(rises | falls) & (above < F(0));
      to = select(never, F(-1), to);
    }

    /// Adds a kink that some lane has inside of its ray.
    int add(F t, F* kinks, int n) const noexcept {
      if (!any((t > F(0)) & (t < t_max_))) return n;
      kinks[n] = t;
      return n + 1;
    }

    /// Adds the kinks of the lower envelope of lines, or of the upper one.
    int envelope(const Line* lines, int count, bool upper, F* kinks, int n) const noexcept {
      const F sign(upper ? Scalar<F>(-1) : Scalar<F>(1));
      F t(0), a(far_away), b(0);
      for (int k = 0; k < count; ++k) {
        const F ak = sign * lines[k].a, bk = sign * lines[k].b;
        const Mask<F> lower = (ak < a) | ((ak == a) & (bk < b));
        a = select(lower, ak, a);
        b = select(lower, bk, b);
      }
      for (int step = 1; step < count; ++step) {
        F t_next = t_max_, a_next = a, b_next = b;
        for (int k = 0; k < count; ++k) {
          const F ak = sign * lines[k].a, bk = sign * lines[k].b;
          const Mask<F> steeper = bk < b;
          const F cross = (ak - a) / select(steeper, b - bk, F(1));
          const Mask<F> sooner = steeper & ((cross < t_next) | ((cross == t_next) & (bk < b_next)));
          t_next = select(sooner, cross, t_next);
          a_next = select(sooner, ak, a_next);
          b_next = select(sooner, bk, b_next);
        }
        if (!any(b_next < b)) break;
        t = clamp(t_next, t, t_max_);
        n = add(t, kinks, n);
        a = a_next, b = b_next;
      }
      return n;
    }

    const Joined& joined_;
    F t_max_;
    Line front_[most_faces + most_parts], back_[most_faces];
    Range ranges_[most_parts];
  };

  const Medium* media_;
  Vec3<double> centre_;  ///< the origin of the local coordinates  [m]
  int part_count_ = 0;
  std::array<Part, most_parts> parts_;
  std::array<Plane, most_faces> faces_;
};

}  // namespace airlight::inline AIRLIGHT_ISA
