#pragma once
#include "estimate.h"

namespace airlight::inline AIRLIGHT_ISA {

/// How samples become radiance: from the closed form without shadows A, and from the same samples
/// the sums with shadows O and without U, each an unbiased estimate of what it stands for, to the
/// four sums of an `Estimate`.
template <class M>
concept Form = requires(const M form, Rgb<double> sum) {
  { M::name } -> std::convertible_to<const char*>;
  { M::meaning } -> std::convertible_to<const char*>;
  { form(sum, sum, sum) } -> std::same_as<Estimate<double>>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
