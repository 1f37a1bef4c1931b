#pragma once
#include "../form.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The plain mean of weighted visibilities, Velinov 2021 Eq. 2: L = O. Unbiased.
struct MonteCarlo {
  static constexpr auto name = "monte_carlo";
  static constexpr auto meaning = "the mean of the weighted samples; unbiased";

  template <class F>
  Estimate<F> operator()(Rgb<F>, Rgb<F> occluded, Rgb<F>) const noexcept {
    return {.plain = occluded, .analytic = {}, .occluded = {}, .unoccluded = {}};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
