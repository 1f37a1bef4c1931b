#pragma once
#include <airlight/math/vec.h>

#include "scene/scene.h"

namespace airlight {

/// What is behind everything at pixels of the whole picture, x and y their centres. A picture there
/// is not filtered: each of its pixels is seen by one pixel, so that layers can be laid over it
/// later to the same effect.  [W/(m² sr)]
template <Real F>
Rgb<F> background_at(const Scene& scene, F x, F y) noexcept {
  if (!scene.background_is_seen) return Rgb<F>();
  const Image& plate = scene.background_image;
  if (plate.pixels.empty()) return Rgb<F>(scene.background);
  alignas(64) Scalar<F> values[3][lanes<F>];
  for (int i = 0; i < lanes<F>; ++i)
    for (int c = 0; c < 3; ++c) values[c][i] = plate.at(int(lane(x, i)), int(lane(y, i)), c);
  return Rgb<F>(load<F>(values[0]), load<F>(values[1]), load<F>(values[2]));
}

}  // namespace airlight
