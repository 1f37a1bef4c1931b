#pragma once
#include "math/vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What an estimator may ask of the scene. A user of the headers brings a struct of his own; the
/// renderer's is made of Embree.
///
///     Rgb<F> transmit(Vec3<F> from, Vec3<F> direction, F t_max, int light, Mask<F> active)
///
/// is the part of the light that passes along a segment: 0 where it is blocked, 1 where it is free,
/// between for glass and cut-outs. `light` is the index of the light asked for. What it gives for
/// lanes that are not active does not matter.
template <class W, class F>
concept AnswersVisibility = requires(const W world, Vec3<F> v, F t, Mask<F> active) {
  { world.transmit(v, v, t, 0, active) } -> std::same_as<Rgb<F>>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
