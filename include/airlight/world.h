#pragma once
#include "math/vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The index of no light.
inline constexpr int no_light = -1;

/// What an estimator may ask of the scene. A user of the headers brings a struct of his own; the
/// renderer's is made of Embree.
///
///     Rgb<F> transmit(Vec3<F> from, Vec3<F> direction, F t_max, int light, Mask<F> active)
///
/// is the part of the light that passes along a segment: 0 where it is blocked, 1 where it is free,
/// between for glass and cut-outs. `light` is the index of the light asked for: the picture in a
/// beam is part of the answer; `no_light` stands for a camera ray. What it gives for lanes that are
/// not active does not matter.
template <class W, class F>
concept AnswersVisibility = requires(const W world, Vec3<F> v, F t, Mask<F> active) {
  { world.transmit(v, v, t, 0, active) } -> std::same_as<Rgb<F>>;
};

/// A world in which nothing stands in the way of light.
struct Unshadowed {
  template <class F>
  Rgb<F> transmit(Vec3<F>, Vec3<F>, F, int, Mask<F>) const noexcept {
    return Rgb<F>(F(1));
  }
  /// Where the camera ray is lit, for the closed form: everywhere.
  template <class Sink>
  void lit(Vec3<double>, Vec3<double>, double t_max, int, Sink&& sink) const noexcept {
    sink(0, t_max);
  }
};

/// A world made of a function: `visible(from, direction, t_max)` is what passes along a segment, a
/// number in [0, 1] or a colour of such.
///
///     const VisibleBy above_ground{[](auto from, auto direction, auto t_max) { … }};
template <class Function>
struct VisibleBy {
  Function visible;

  template <class F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> direction, F t_max, int, Mask<F>) const noexcept {
    return Rgb<F>(visible(from, direction, t_max));
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
