#pragma once
#include <optional>

#include "distance.h"
#include "equidistant.h"
#include "whole_volume.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Whole-volume samples mixed with another placement's by one-sample multiple importance sampling
/// (Velinov 2021 section 1.2): the density is the mixture's, so no weight exceeds that of either
/// placement over its part.
struct Mixed {
  enum class Partner { equidistant, distance };

  Partner partner = Partner::distance;
  double part = 0.5;  ///< of the samples that the partner draws, in (0, 1)

  static constexpr auto name = "mix";
  static constexpr auto meaning = "whole_volume mixed with another placement in one sample";

  template <class Section>
  struct On;

  template <class Section, class Strength>
  On<Section> on(const Section& section, const Strength& strength) const noexcept {
    return {*this, section, strength};
  }
};

template <Real F, int channels, class Space>
struct Mixed::On<Section<F, channels, Space>> {
  using In = Section<F, channels, Space>;
  const Mixed& mix;
  WholeVolume::On<In> whole_volume;
  Equidistant::On<In> equidistant;
  std::optional<Distance::On<In>> distance;  ///< if it is the partner

  On(const Mixed& m, const In& section, const Channels<F, channels>& strength) noexcept
      : mix(m), whole_volume(section, strength), equidistant{section} {
    if (mix.partner == Partner::distance) distance.emplace(section, strength);
  }

  F sample(F u) const noexcept {
    const F part(Scalar<F>(mix.part));
    const Mask<F> first = u < part;
    const F v = clamp(select(first, u / part, (u - part) / (F(1) - part)), F(0), F(1));
    const F partner = distance ? distance->sample(v) : equidistant.sample(v);
    return select(first, partner, whole_volume.sample(v));
  }

  F pdf(F t, const typename In::Point& at) const noexcept {
    const F partner = distance ? distance->pdf(t, at) : equidistant.pdf(t, at);
    return fma(F(Scalar<F>(mix.part)), partner,
               F(Scalar<F>(1 - mix.part)) * whole_volume.pdf(t, at));
  }

  Channels<F, channels> weights(F t, const typename In::Point& at) const noexcept {
    return balanced_weights<F, channels>(whole_volume.section.reaching(at), pdf(t, at));
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
