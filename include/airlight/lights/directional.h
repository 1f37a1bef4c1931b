#pragma once
#include "../light.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Light from far away: parallel, or from a disc of sky such as the sun's.
struct Directional {
  /// On a surface that faces the light, outside the medium: of a disc, summed over its parts, each
  /// on a surface that faces that part.  [W/m2]
  Rgb<double> irradiance{1, 1, 1};
  Vec3<double> direction{0, -1, 0};  ///< of travel, unit length
  double angular_diameter = 0;       ///< of the disc; 0 is parallel light  [degrees]

  static constexpr auto name = "directional";
  static constexpr auto meaning = "light from far away: parallel, or from a disc such as the sun's";
  static constexpr bool everywhere = true;

  /// Unit vector towards the light.
  Vec3<double> toward() const noexcept { return -direction; }

  /// Whether it reaches a point that nothing shades: everywhere.
  template <Real F>
  Mask<F> contains(Vec3<F>) const noexcept {
    return F(0) == F(0);
  }

  /// How far things can stand in its way: without end.  [m]
  template <Real F>
  F reach(Vec3<F>) const noexcept {
    return F(far_away);
  }

  /// 1 − cos of the disc's angular radius, without cancellation.
  double cap_height() const noexcept {
    const double s = std::sin(angular_diameter * (pi / 720));
    return 2 * s * s;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
