#pragma once
#include <airlight/math/simd.h>

#include <array>
#include <cstdint>

namespace airlight {

/// Where rays meet the scene first, a ray a lane.
template <Real F>
struct Hit {
  /// Stands for an object where nothing was found.
  static constexpr std::uint32_t nothing = 0xffffffff;

  F t;            ///< in units of the direction's length; far_away where nothing was found
  Mask<F> found;  ///< what follows counts only there
  std::array<std::uint32_t, lanes<F>> object;     ///< index into Scene::objects
  std::array<std::uint32_t, lanes<F>> primitive;  ///< triangle of the mesh
  std::array<float, lanes<F>> u, v;               ///< the point on it, for `World::surface`

  /// Nothing found in any lane.
  static Hit none() noexcept {
    Hit hit{};
    hit.t = F(Scalar<F>(far_away));
    hit.found = hit.t < F(0);
    hit.object.fill(nothing);
    return hit;
  }
};

}  // namespace airlight
