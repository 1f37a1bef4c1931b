#pragma once
#include "describe.h"
#include "way_out.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A ray in a shape's own coordinates, where its formulas are simple. t stays the distance in the
/// world.
template <Real F>
struct LocalRay {
  Vec3<F> o, d;

  Vec3<F> operator()(F t) const noexcept {
    return {fma(t, d.x, o.x), fma(t, d.y, o.y), fma(t, d.z, o.z)};
  }
};

/// Components of the direction to the light below this, relative to its length, count as zero: the
/// distance out through a face that is all but parallel to the light is ill-conditioned (error eps
/// / component), while the exact effect on T is confined to where the ray is nearer than that to
/// the face: below 3e-4 of t_max but for rays that glide along it.
template <Real F>
inline constexpr Scalar<F> parallel_below = Scalar<F>(std::same_as<F, double> ? 1e-12 : 1e-5);

/// Where a medium is. A shape is plain numbers in world space; its `space()` is what a ray needs of
/// it, once a frame:
///
///     space.point(p), space.vector(v)     world to local (affine)
///     space.clip(ray)                     the interval of t inside, not before the ray's origin;
///                                         of a concave shape from the first entry to the last exit
///
/// and, of a convex shape,
///
///     space.outward(w)                    what is shared by all points when light comes from w
///     (local) space.way_out(ray, outward, t_max)  the way out for a ray that starts inside
///
/// or, of a concave one, what `CutsInPieces` asks for.
template <class S>
concept Shape = requires(const S shape, LocalRay<double> ray, Vec3<double> v) {
  { S::name } -> std::convertible_to<const char*>;
  { S::meaning } -> std::convertible_to<const char*>;
  { shape.space().point(v) } -> std::same_as<Vec3<double>>;
  { shape.space().vector(v) } -> std::same_as<Vec3<double>>;
  { shape.space().clip(ray) } -> std::same_as<Interval<double>>;
};

/// A shape that every line meets in one interval.
template <class S>
concept ConvexShape = Shape<S> && requires(const S shape, LocalRay<double> ray, Vec3<double> v) {
  {
    shape.space().way_out(ray, shape.space().outward(v), 1.).length_at(0.)
    } -> std::same_as<double>;
};

/// A plane that light starts at: the distance to it from the point p(t) of a ray, along w, is
/// a + b t; by default it is out of reach.
template <Real F>
struct LightStart {
  F a{F(far_away)}, b{F(0)};

  F operator()(F t) const noexcept { return fma(b, t, a); }
};

/// A space that says that the optical depth of the whole way is not concave in it, as in one convex
/// body, but linear in pieces: of media side by side, or inside a concave boundary. What it then
/// owes, `CutsInPieces` tells.
template <class Space>
concept InPieces = requires {
  requires Space::in_pieces;
};

}  // namespace airlight::inline AIRLIGHT_ISA
