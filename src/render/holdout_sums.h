#pragma once
#include <airlight/math/vec.h>

namespace airlight {

/// What a pixel sees of holdouts, in sums. Where they are, the background's picture shows, which
/// was taken in the light of their own shadows. What that light loses to the other objects'
/// shadows and to the medium, the picture loses, too:
///
///     radiance = plate · lit / was_lit    [W/(m² sr)]
///
/// with the `HoldoutLight` of all lights. Holdouts that shadow each other do so above and below, so
/// that nothing darkens twice.
template <class F>
struct HoldoutSums {
  Rgb<F> seen;   ///< what passes from the holdouts to the camera
  Rgb<F> plate;  ///< the background in their place, as it passes  [W/(m² sr)]

  HoldoutSums& operator+=(const HoldoutSums& other) noexcept {
    seen += other.seen, plate += other.plate;
    return *this;
  }
  friend HoldoutSums operator*(const HoldoutSums& h, F s) noexcept {
    return {h.seen * s, h.plate * s};
  }
};

/// Light that arrives at holdouts, times what passes from there to the camera, in sums.
template <class F>
struct HoldoutLight {
  Rgb<F> lit;      ///< [W/m²]
  Rgb<F> was_lit;  ///< the same without the medium and without objects that are no holdouts

  HoldoutLight& operator+=(const HoldoutLight& other) noexcept {
    lit += other.lit, was_lit += other.was_lit;
    return *this;
  }
  friend HoldoutLight operator*(const HoldoutLight& h, const Rgb<F>& s) noexcept {
    return {h.lit * s, h.was_lit * s};
  }

  /// What is left of the light, by channel; 1 where there was none.
  Rgb<F> shadow() const noexcept {
    const auto channel = [](F now, F before) {
      return select(before > F(0), now / select(before > F(0), before, F(1)), F(1));
    };
    return {channel(lit.r, was_lit.r), channel(lit.g, was_lit.g), channel(lit.b, was_lit.b)};
  }
};

}  // namespace airlight
