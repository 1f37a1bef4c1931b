#pragma once
#include <airlight/lights/collimated.h>

#include "image/texture.h"

namespace airlight {

/// What the image of a beam lets pass at points of the beam, in [0, 1] for each channel: nothing
/// where it is transparent, as if it lay on black. 0 in lanes that are not active.
template <Real F>
Rgb<F> through_image(const Collimated& beam, const Texture& image, Vec3<F> at,
                     Mask<F> active) noexcept {
  const Vec2<double> low = beam.cross_section.low, high = beam.cross_section.high;
  const Vec2<F> p = beam.across(at - Vec3<F>(beam.position));
  const F u = (p.x - F(Scalar<F>(low.x))) * F(Scalar<F>(1 / (high.x - low.x)));
  const F v = (p.y - F(Scalar<F>(low.y))) * F(Scalar<F>(1 / (high.y - low.y)));
  const std::uint32_t which = bits<F>(active);
  alignas(64) Scalar<F> values[3][lanes<F>] = {};
  for (int i = 0; i < lanes<F>; ++i) {
    if ((which >> i & 1) == 0) continue;
    const std::array<float, 3> passes = image.over_black(float(lane(u, i)), float(lane(v, i)));
    for (int c = 0; c < 3; ++c) values[c][i] = passes[std::size_t(c)];
  }
  return {load<F>(values[0]), load<F>(values[1]), load<F>(values[2])};
}

}  // namespace airlight
