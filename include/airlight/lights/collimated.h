#pragma once
#include "../cross_section.h"
#include "../light.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A beam of parallel light with a sharp outline, from a plane on: a spotlight of the stage, a
/// projector, a laser, daylight behind a stencil (a gobo).
struct Collimated {
  Rgb<double> irradiance{1, 1, 1};   ///< across the beam, where it starts  [W/m2]
  Vec3<double> position;             ///< where the beam starts: a point of the start plane  [m]
  Vec3<double> direction{0, -1, 0};  ///< of travel, unit length; normal to the start plane
  /// Unit vectors along the start plane, the axes of the cross-section about `position`: right =
  /// direction × up is on the right of who looks along the beam.
  Vec3<double> right{1, 0, 0}, up{0, 0, -1};
  CrossSection cross_section;
  /// An image fills the rectangle around the cross-section and filters the beam. Which one is known
  /// to the World: it multiplies it into what this light transmits. −1: none.
  int image = -1;

  static constexpr auto name = "collimated";
  static constexpr auto meaning =
      "a beam of parallel light with an outline and, if asked, a picture (a gobo)";
  static constexpr bool everywhere = false;

  static constexpr double angular_diameter = 0;
  static constexpr double cap_height() noexcept { return 0; }

  /// Unit vector towards the light.
  Vec3<double> toward() const noexcept { return -direction; }

  /// How far it is from a point back to the start plane; 0 before it, where rounding or a step off
  /// a surface can put a point of the beam.  [m]
  template <Real F>
  F reach(Vec3<F> from) const noexcept {
    return max(dot(from - Vec3<F>(position), Vec3<F>(direction)), F(0));
  }

  /// Where a point lies in the cross-section's coordinates.  [m]
  template <Real F>
  Vec2<F> across(Vec3<F> from_position) const noexcept {
    return {dot(from_position, Vec3<F>(right)), dot(from_position, Vec3<F>(up))};
  }

  /// Whether a point lies in the beam.
  template <Real F>
  Mask<F> contains(Vec3<F> p) const noexcept {
    const Vec2<F> still{F(0), F(0)};
    const Interval<F> all = cross_section.clip(across(p - Vec3<F>(position)), still);
    return (all.t_enter < all.t_exit) & (reach(p) > F(0));
  }

  /// The part of a ray that lies in the beam, in either direction of the ray; empty where t_exit <=
  /// t_enter.
  template <Real F>
  Interval<F> clip(Vec3<F> origin, Vec3<F> d) const noexcept {
    const Vec3<F> q = origin - Vec3<F>(position);
    Interval<F> inside = cross_section.clip(across(q), across(d));
    keep_where_positive(inside, dot(q, Vec3<F>(direction)), dot(d, Vec3<F>(direction)));
    return inside;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
