#pragma once
#include "../form.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The closed form times the lit part of the samples, Velinov 2021 Eq. 3: L = A O / U. Consistent,
/// and exact wherever visibility is constant along the ray; the quotient is formed once, from sums
/// over all samples.
struct Ratio {
  static constexpr auto name = "ratio";
  static constexpr auto meaning =
      "the closed form times the lit part of the samples; no noise where visibility is constant";

  template <class F>
  Estimate<F> operator()(Rgb<F> analytic, Rgb<F> occluded, Rgb<F> unoccluded) const noexcept {
    return {.plain = {}, .analytic = analytic, .occluded = occluded, .unoccluded = unoccluded};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
