#pragma once
#include "medium.h"
#include "pieces.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A section of a camera ray through media whose optical depth is linear in pieces. It answers what
/// `Section` does elsewhere; what scatters is part of it, as it changes along the ray.
template <Real F, int channels_, InPieces Space>
struct Section<F, channels_, Space> {
  static constexpr int channels = channels_;
  using Inside = typename Space::template StretchesOf<F>;
  using Cut = typename Space::template PiecesOf<F, channels>;
  using Point = typename Cut::Point;

  const Space& space;
  LocalRay<F> ray;  ///< from the entry, in the space's coordinates
  Vec3<F> w;        ///< towards the light, in the space's coordinates
  F t_max;          ///< the length of the section, >= 0  [m]
  Inside inside;    ///< the ray's own stretches
  Cut pieces;
  Channels<F, channels> integral;  ///< of what scatters and reaches the camera; without irradiance

  Section(const Space& space_, const LocalRay<F>& ray_, Vec3<F> w_, F t_max_,
          const Medium& medium) noexcept
      : space(space_), ray(ray_), w(w_), t_max(t_max_), inside(space_.stretches(ray_, medium)) {}

  void trace_way_out() noexcept {
    space.template cut<channels>(ray, w, t_max, inside, pieces);
    pieces.integrate();
    integral = pieces.whole();
  }

  /// What is known of the point at t.
  Point at(F t) const noexcept { return pieces.at(t); }

  /// The same for light from elsewhere, without the pieces.
  Point seen(F t, Vec3<F> toward) const noexcept {
    return space.template seen<channels>(ray, t, toward, inside);
  }

  /// What a metre scatters there and reaches the camera, without irradiance.
  Channels<F, channels> reaching(const Point& at) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = at.strength[c] * exp(-at.depth[c]);
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
