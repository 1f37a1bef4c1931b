#pragma once
#include "phases.h"
#include "shapes.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A homogeneous participating medium.
struct Medium {
  Rgb<double> sigma_s{0, 0, 0};   ///< scattering coefficient  [1/m]
  Rgb<double> sigma_t{0, 0, 0};   ///< extinction coefficient, at least sigma_s  [1/m]
  Rgb<double> emission{0, 0, 0};  ///< radiance gained a metre  [W/(m3 sr)]
  Phases phase = Isotropic{};
  Shapes shape = Box{};

  /// Whether the three channels are extinguished alike.
  bool is_grey() const noexcept { return sigma_t.r == sigma_t.g && sigma_t.g == sigma_t.b; }
};

}  // namespace airlight::inline AIRLIGHT_ISA
