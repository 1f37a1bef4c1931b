#pragma once
#include <array>
#include <span>

#include "../shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The side {x : n·x <= h} of a plane.
struct Plane {
  Vec3<double> n;  ///< unit normal, pointing out
  double h = 0;    ///< [m]
};

/// The part of a ray inside of all planes, ahead of its origin.
template <Real F>
Interval<F> clip_by_planes(std::span<const Plane> faces, const LocalRay<F>& ray) noexcept {
  Interval<F> inside{F(0), F(far_away)};
  for (const Plane& face : faces) {
    const Vec3<F> n(face.n);
    const F facing = dot(n, ray.d), above = F(Scalar<F>(face.h)) - dot(n, ray.o);
    const Mask<F> along = abs(facing) < F(1e-30f);
    const F t = above / select(along, F(1), facing);
    const F missed = select(above < F(0), F(far_away), F(0));
    inside.t_enter = max(inside.t_enter, select(along, missed, select(facing < F(0), t, F(0))));
    inside.t_exit = min(inside.t_exit, select(along | (facing < F(0)), F(far_away), t));
  }
  return inside;
}

/// A convex polyhedron: what is inside all of its planes.
struct Convex {
  static constexpr int max_faces = 64;

  std::array<Plane, max_faces> faces;
  int face_count = 0;
  Vec3<double> centre;  ///< a point near the middle, the origin of the local coordinates  [m]

  static constexpr auto name = "convex";
  static constexpr auto meaning = "a convex polyhedron, from its planes or as the hull of points";

  /// World coordinates about the centre, with the faces' offsets from it.
  struct Space {
    Vec3<double> centre;
    std::array<Plane, max_faces> faces;
    int face_count;

    template <Real F>
    Vec3<F> point(Vec3<F> p) const noexcept {
      return p - Vec3<F>(centre);
    }
    template <Real F>
    Vec3<F> vector(Vec3<F> v) const noexcept {
      return v;
    }

    template <Real F>
    Interval<F> clip(const LocalRay<F>& ray) const noexcept {
      return clip_by_planes(std::span(faces).first(std::size_t(face_count)), ray);
    }

    template <Real F>
    struct Outward {
      Vec3<F> w;
      F least;  ///< faces with n·w below it count as parallel to the light
    };

    template <Real F>
    Outward<F> outward(Vec3<F> w) const noexcept {
      return {w, F(parallel_below<F>) * length(w)};
    }

    static constexpr int max_segments = max_faces;

    /// The lower envelope of a line a face, walked from kink to kink: usually one to three steps.
    template <Real F>
    WayOut<F, max_segments> way_out(const LocalRay<F>& ray, const Outward<F>& out,
                                    F t_max) const noexcept {
      F a[max_faces], b[max_faces];
      for (int k = 0; k < face_count; ++k) {
        const Vec3<F> n(faces[k].n);
        const F facing = dot(n, out.w);
        const Mask<F> met = facing > out.least;
        const F inverse = F(1) / select(met, facing, F(1));
        a[k] = select(met, (F(Scalar<F>(faces[k].h)) - dot(n, ray.o)) * inverse, F(far_away));
        b[k] = select(met, -dot(n, ray.d) * inverse, F(0));
      }
      WayOut<F, max_segments> way;
      F a_now(far_away), b_now(0);
      for (int k = 0; k < face_count; ++k) {
        const Mask<F> lower = (a[k] < a_now) | ((a[k] == a_now) & (b[k] < b_now));
        a_now = select(lower, a[k], a_now);
        b_now = select(lower, b[k], b_now);
      }
      way.t[0] = F(0);
      int n = 0;
      for (;;) {
        way.a[n] = a_now, way.b[n] = b_now;
        ++n;
        if (n == face_count) break;
        F t_next = t_max, a_next = a_now, b_next = b_now;
        for (int k = 0; k < face_count; ++k) {
          const F slope = b_now - b[k];
          const Mask<F> steeper = slope > F(0);
          const F t = (a[k] - a_now) / select(steeper, slope, F(1));
          const Mask<F> sooner = steeper & ((t < t_next) | ((t == t_next) & (b[k] < b_next)));
          t_next = select(sooner, t, t_next);
          a_next = select(sooner, a[k], a_next);
          b_next = select(sooner, b[k], b_next);
        }
        if (!any(b_next < b_now)) break;
        way.t[n] = clamp(t_next, way.t[n - 1], t_max);
        a_now = a_next, b_now = b_next;
      }
      way.segments = n;
      way.t[n] = t_max;
      way.measure();
      return way;
    }
  };

  Space space() const noexcept {
    Space result{centre, faces, face_count};
    for (int k = 0; k < face_count; ++k) result.faces[k].h -= dot(faces[k].n, centre);
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
