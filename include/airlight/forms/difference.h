#pragma once
#include "../form.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The closed form less the shadowed part of the samples: L = A − (U − O), the samples as a control
/// variate. Unbiased, and exact where nothing is shadowed.
struct Difference {
  static constexpr auto name = "difference";
  static constexpr auto meaning =
      "the closed form less the shadowed part of the samples; unbiased, no noise where lit";

  template <class F>
  Estimate<F> operator()(Rgb<F> analytic, Rgb<F> occluded, Rgb<F> unoccluded) const noexcept {
    return {.plain = analytic + (occluded - unoccluded),
            .analytic = {},
            .occluded = {},
            .unoccluded = {}};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
