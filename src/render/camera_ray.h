#pragma once
#include <airlight/math/warp.h>

#include "render/frame.h"

namespace airlight {

/// Offset of a camera ray from its pixel's centre, drawn from the filter.  [pixels]
template <Real F>
Vec2<F> filter_offset(PixelFilter filter, Vec2<F> u) noexcept {
  if (filter == PixelFilter::box) return {u.x - F(0.5), u.y - F(0.5)};
  if (filter == PixelFilter::tent) {
    const auto tent = [](F v) {
      const F side = sqrt(F(2) * min(v, F(1) - v));
      return select(v < F(0.5), side - F(1), F(1) - side);
    };
    return {tent(u.x), tent(u.y)};
  }
  constexpr double deviation = 0.5, cut = 1.5;
  const F within(1 - 0.011108996538242306);  // 1 − exp(−(cut / deviation)² / 2)
  const F radius = min(F(deviation) * sqrt(F(-2) * log1p_minus(u.x * within)), F(cut));
  F sine, cosine;
  sin_cos_turn(u.y, sine, cosine);
  return {radius * cosine, radius * sine};
}

/// Of the ray through a point of the picture, in pixels from its upper left corner.
template <Real F>
Vec3<F> camera_direction(const CameraFrame& camera, F x, F y) noexcept {
  return normalize(Vec3<F>(camera.corner) + Vec3<F>(camera.right) * x + Vec3<F>(camera.down) * y);
}

}  // namespace airlight
