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
  using Point = typename Section<F, channels, Space>::Point;
  const Section<F, channels, Space>& section;
  Channels<F, channels> share;  ///< of the section's channels in what is drawn
  Channels<F, channels>
      scale;  ///< chance / T: the mixture's density is Σ_c scale_c e^{−σ_c length}  [1/m]

  On(const Section<F, channels, Space>& s, const Channels<F, channels>& strength) noexcept
      : section(s) {
    Channels<F, channels> carried;
    for (int c = 0; c < channels; ++c) carried[c] = strength[c] * s.integral[c];
    const Channels<F, channels> chance = chances<F, channels>(carried);
    share = s.shares(chance);
    for (int c = 0; c < channels; ++c) {
      const Mask<F> some = s.integral[c] > F(0);
      scale[c] = select(some, chance[c] / select(some, s.integral[c], F(1)), F(0));
    }
  }

  F sample(F u) const noexcept { return section.draw(share, u); }

  F pdf(F, const Point& at) const noexcept {
    if constexpr (channels == 1)
      return section.density(at);
    else
      return mixture(section.reaching(at));
  }

  Channels<F, channels> weights(F, const Point& at) const noexcept {
    if constexpr (channels == 1)
      return section.integral;
    else {
      const Channels<F, channels> reaching = section.reaching(at);
      return balanced_weights<F, channels>(reaching, mixture(reaching));
    }
  }

 private:
  F mixture(const Channels<F, channels>& reaching) const noexcept {
    F sum(0);
    for (int c = 0; c < channels; ++c) sum = fma(scale[c], reaching[c], sum);
    return sum;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
