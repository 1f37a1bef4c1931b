#pragma once

namespace airlight {

/// The layer "shadow", in one channel: what is left of a background of which `transmittance` passes
/// to the camera, `seen` of that in the place of holdouts, if `left` is left of the light there.
template <class T>
T shadow_on_background(T seen, T transmittance, T left) noexcept {
  if (!(transmittance > 0)) return 1;
  const T part = seen < transmittance ? seen / transmittance : 1;
  return 1 - part * (1 - left);
}

}  // namespace airlight
