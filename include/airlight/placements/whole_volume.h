#pragma once
#include "../placement.h"

namespace airlight::inline AIRLIGHT_ISA {

/// In proportion to transmittance along the whole way, from the camera to the sample and on to
/// where light enters: Velinov 2021 sections 5 and 6. In a grey medium every weight is T: where
/// nothing is shadowed, one sample is exact.
struct WholeVolume {
  static constexpr auto name = "whole_volume";
  static constexpr auto meaning =
      "in proportion to the transmittance of the whole way, camera to sample to light";

  template <class Section>
  struct On;

  template <class Section, class Strength>
  On<Section> on(const Section& section, const Strength& strength) const noexcept {
    return {section, strength};
  }
};

template <Real F, int channels, class Space>
struct WholeVolume::On<Section<F, channels, Space>> {
  const Section<F, channels, Space>& section;
  Channels<F, channels> chance;

  On(const Section<F, channels, Space>& s, const Channels<F, channels>& strength) noexcept
      : section(s) {
    Channels<F, channels> carried;
    for (int c = 0; c < channels; ++c) carried[c] = strength[c] * s.integral[c];
    chance = chances<F, channels>(carried);
  }

  F sample(F u) const noexcept {
    return draw_by_channel<F, channels>(
        chance, u, [&](int c, F v) { return section.trapezoids[c].sample(section.way, v); });
  }

  F pdf(F, F length) const noexcept {
    F sum(0);
    for (int c = 0; c < channels; ++c)
      sum = fma(chance[c], section.trapezoids[c].pdf(length, section.sigma_t[c]), sum);
    return sum;
  }

  Channels<F, channels> weights(F t, F length) const noexcept {
    if constexpr (channels == 1)
      return section.integral;
    else
      return balanced_weights<F, channels>(section.transmittance(length), pdf(t, length));
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
