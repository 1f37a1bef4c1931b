#pragma once
#include "estimator.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The part of a packet of rays that a light reaches where nothing stands in its way, and the space
/// in which its way out ends where the light starts: what a `Section` is made of.
template <class Space, class Ray>
struct LitPart {
  Space space;
  Ray ray;
};

/// A shape's space for a packet of rays and a light that starts at a plane, at the distance a + b t
/// from the point p(t) of the ray. There, too, the way out ends.
template <Real F, class Space>
struct SpaceBelowStart {
  static constexpr int max_segments = Space::max_segments + 2;
  template <Real G>
  using Outward = typename Space::template Outward<G>;

  const Space& space;
  F a, b;

  Interval<F> clip(const LocalRay<F>& ray) const noexcept { return space.clip(ray); }
  Outward<F> outward(Vec3<F> w) const noexcept { return space.outward(w); }

  WayOut<F, max_segments> way_out(const LocalRay<F>& ray, const Outward<F>& out,
                                  F t_max) const noexcept {
    return space.way_out(ray, out, t_max).with_line(a, b);
  }
};

/// The same where the optical depth is linear in pieces.
template <Real F, InPieces Space>
struct SpaceBelowStart<F, Space> {
  static constexpr bool in_pieces = true, one_medium = Space::one_medium;
  static constexpr int most_stretches = Space::most_stretches;
  template <Real G>
  using StretchesOf = typename Space::template StretchesOf<G>;
  template <Real G, int channels>
  using PiecesOf = typename Space::template PiecesOf<G, channels>;

  const Space& space;
  F a, b;

  template <Real G>
  Vec3<G> point(Vec3<G> p) const noexcept {
    return space.point(p);
  }
  StretchesOf<F> stretches(const LocalRay<F>& ray, const Medium& medium) const noexcept {
    return space.stretches(ray, medium);
  }
  template <int channels>
  void cut(const LocalRay<F>& ray, Vec3<F> w, F t_max, const StretchesOf<F>& inside,
           PiecesOf<F, channels>& pieces) const noexcept {
    space.template cut<channels>(ray, w, t_max, inside, pieces, LightStart<F>{a, b});
  }
  template <int channels>
  auto seen(const LocalRay<F>& ray, F t, Vec3<F> w, const StretchesOf<F>& inside) const noexcept {
    return space.template seen<channels>(ray, t, w, inside, LightStart<F>{a, b});
  }
  template <class Cut>
  static void set_scale(Cut& pieces, const StretchesOf<F>& inside, F cosine) noexcept {
    Space::set_scale(pieces, inside, cosine);
  }
};

/// Light from far away reaches all of the ray.
template <Real F, class Space>
LitPart<const Space&, const MediumRay<F>&> lit_part(const Directional&, const Medium&,
                                                    const Space& space,
                                                    const MediumRay<F>& ray) noexcept {
  return {space, ray};
}

/// A beam reaches what lies inside of it. The ray begins where it enters the beam, dimmed by the
/// medium before that.
template <Real F, class Space>
LitPart<SpaceBelowStart<F, Space>, MediumRay<F>> lit_part(const Collimated& beam,
                                                          const Medium& medium, const Space& space,
                                                          const MediumRay<F>& ray) noexcept {
  const Interval<F> inside = beam.clip(ray.origin, ray.direction);
  const F first = max(inside.t_enter - ray.t_enter, F(0));
  const F last = min(inside.t_exit - ray.t_enter, ray.t_max);
  const Mask<F> meets = ray.active & (last > first);
  const F begin = select(meets, first, F(0));
  MediumRay<F> part = ray;
  part.entry.o = ray.entry(begin);
  part.t_enter = ray.t_enter + begin;
  part.t_max = select(meets, last - first, F(0));
  part.active = meets;
  if constexpr (InPieces<Space>)
    part.dimmed *= space.stretches(ray.entry, medium).transmittance(begin);
  else
    part.dimmed *= exp_minus(Rgb<F>(medium.sigma_t) * begin);
  const F to_start = beam.reach(ray.origin + ray.direction * part.t_enter);
  return {{space, to_start, dot(ray.direction, Vec3<F>(beam.direction))}, part};
}

}  // namespace airlight::inline AIRLIGHT_ISA
