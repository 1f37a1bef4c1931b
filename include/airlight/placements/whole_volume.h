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
  Channels<F, channels>
      scale;  ///< chance / T: the mixture's density is Σ_c scale_c e^{−σ_c length}  [1/m]

  On(const Section<F, channels, Space>& s, const Channels<F, channels>& strength) noexcept
      : section(s) {
    Channels<F, channels> carried;
    for (int c = 0; c < channels; ++c) carried[c] = strength[c] * s.integral[c];
    chance = chances<F, channels>(carried);
    for (int c = 0; c < channels; ++c) {
      const Mask<F> some = s.integral[c] > F(0);
      scale[c] = select(some, chance[c] / select(some, s.integral[c], F(1)), F(0));
    }
  }

  F sample(F u) const noexcept {
    if constexpr (channels == 1)
      return section.trapezoids[0].sample(section.way, u);
    else {
      // The trapezoids of the channel drawn, put together lane by lane: one inversion instead of
      // three.
      const ChannelPick<F, channels> pick(chance, u);
      Trapezoids<F, Space::max_segments> drawn;
      const auto of = [&](auto member) {
        return pick.of({member(section.trapezoids[0]), member(section.trapezoids[1]),
                        member(section.trapezoids[2])});
      };
      drawn.total = of([](const auto& t) { return t.total; });
      for (int i = 0; i <= 1 || i <= section.way.segments; ++i)  // one segment at least
        drawn.depth_at[i] = of([i](const auto& t) { return t.depth_at[i]; });
      for (int i = 0; i < 1 || i < section.way.segments; ++i) {
        drawn.integral[i] = of([i](const auto& t) { return t.integral[i]; });
        drawn.drop[i] = of([i](const auto& t) { return t.drop[i]; });
      }
      return drawn.sample(section.way, pick.u);
    }
  }

  F pdf(F, F length) const noexcept {
    if constexpr (channels == 1)
      return section.trapezoids[0].pdf(length, section.sigma_t[0]);
    else
      return mixture(section.transmittance(length));
  }

  Channels<F, channels> weights(F, F length) const noexcept {
    if constexpr (channels == 1)
      return section.integral;
    else {
      const Channels<F, channels> transmittance = section.transmittance(length);
      return balanced_weights<F, channels>(transmittance, mixture(transmittance));
    }
  }

 private:
  F mixture(const Channels<F, channels>& transmittance) const noexcept {
    F sum(0);
    for (int c = 0; c < channels; ++c) sum = fma(scale[c], transmittance[c], sum);
    return sum;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
