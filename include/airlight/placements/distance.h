#pragma once
#include "../placement.h"
#include "../section_in_pieces.h"

namespace airlight::inline AIRLIGHT_ISA {

/// In proportion to transmittance along the camera ray, which ends at the surface or where the ray
/// leaves the medium. The bound matters: the unbounded exponential loses 10 dB at 4 samples in a
/// unit box.
struct Distance {
  static constexpr auto name = "distance";
  static constexpr auto meaning = "in proportion to the transmittance of the camera ray alone";

  template <class Section>
  struct On;

  template <class Section, class Strength>
  On<Section> on(const Section& section, const Strength& strength) const noexcept {
    return {section, strength};
  }
};

template <Real F, int channels, class Space>
struct Distance::On<Section<F, channels, Space>> {
  const Section<F, channels, Space>& section;
  Channels<F, channels> depth;  ///< optical depth of the section
  Channels<F, channels> drop;   ///< 1 − e^{−depth}
  Channels<F, channels> norm;   ///< ∫ e^{−σ t} dt over the section  [m]
  Channels<F, channels> share;  ///< chance / norm  [1/m]

  On(const Section<F, channels, Space>& s, const Channels<F, channels>& strength) noexcept
      : section(s) {
    Channels<F, channels> carried;
    for (int c = 0; c < channels; ++c) {
      depth[c] = s.sigma_t[c] * s.t_max;
      drop[c] = one_minus_exp(depth[c]);
      norm[c] = s.t_max * phi(depth[c]);
      carried[c] = strength[c] * norm[c];
    }
    const Channels<F, channels> chance = chances<F, channels>(carried);
    for (int c = 0; c < channels; ++c) share[c] = chance[c] / select(norm[c] > F(0), norm[c], F(1));
  }

  F sample(F u) const noexcept {
    if constexpr (channels == 1) {
      return section.t_max * exponential_fraction(depth[0], drop[0], u);
    } else {
      ExponentialSum<F, channels> density;
      density.drop = depth, density.whole = F(1);
      for (int c = 0; c < channels; ++c) {
        density.begin[c] = share[c] * section.t_max;
        density.end[c] = density.begin[c] * (F(1) - drop[c]);
      }
      return section.t_max * density.fraction(u);
    }
  }

  F pdf(F t, F /*length*/) const noexcept {
    F sum(0);
    for (int c = 0; c < channels; ++c) sum = fma(share[c], exp(-section.sigma_t[c] * t), sum);
    return sum;
  }

  Channels<F, channels> weights(F t, F length) const noexcept {
    if constexpr (channels == 1)
      return {norm[0] * exp(-section.sigma_t[0] * (length - t))};
    else
      return balanced_weights<F, channels>(section.transmittance(length), pdf(t, length));
  }
};

/// In several media, or in one that the ray leaves and enters again: in proportion also to what
/// scatters, so that nothing is drawn between them.
template <Real F, int channels, InPieces Space>
struct Distance::On<Section<F, channels, Space>> {
  using In = Section<F, channels, Space>;
  const In& section;
  decltype(std::declval<const In&>().camera_way()) camera;
  Channels<F, channels> share;  ///< of the way's channels in what is drawn

  On(const In& s, const Channels<F, channels>& strength) noexcept
      : section(s), camera(s.camera_way()) {
    Channels<F, channels> carried = camera.whole();
    for (int c = 0; c < channels; ++c) carried[c] = carried[c] * strength[c];
    share = camera.shares(chances<F, channels>(carried));
  }

  F sample(F u) const noexcept { return camera.sample(share, u); }

  F pdf(F t, const typename In::Point&) const noexcept {
    const auto at = camera.at(t);
    F sum(0);
    for (int c = 0; c < channels; ++c)
      sum = fma(share[c] * at.strength[c], exp(min(camera.depth[c] - at.depth[c], F(0))), sum);
    return sum;
  }

  Channels<F, channels> weights(F t, const typename In::Point& at) const noexcept {
    return balanced_weights<F, channels>(section.reaching(at), pdf(t, at));
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
