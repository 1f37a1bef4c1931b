#pragma once
#include "section.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Chances to draw from each channel's own distribution, in proportion to what the channels carry;
/// they sum to 1.
template <Real F, int channels>
Channels<F, channels> chances(const Channels<F, channels>& carried) noexcept {
  F sum(0);
  for (F c : carried) sum = sum + c;
  Channels<F, channels> result;
  for (int c = 0; c < channels; ++c)
    result[c] = select(sum > F(0), carried[c] / select(sum > F(0), sum, F(1)), F(1. / channels));
  return result;
}

/// Picks a channel by u and makes u uniform in [0, 1] again: one number serves both, and strata
/// stay strata.
template <Real F, int channels, class Draw>
F draw_by_channel(const Channels<F, channels>& chance, F u, Draw&& draw) noexcept {
  if constexpr (channels == 1)
    return draw(0, u);
  else {
    F result(0), below(0);
    Mask<F> open = u >= F(0);
    for (int c = 0; c < channels; ++c) {
      const F above = below + chance[c];
      const Mask<F> here = c + 1 < channels ? open & (u < above) : open;
      const F positive = select(chance[c] > F(0), chance[c], F(1));
      result = select(here, draw(c, clamp((u - below) / positive, F(0), F(1))), result);
      open = open & !here;
      below = above;
    }
    return result;
  }
}

/// Σ_j chance_j · density_j, and the weights e^{−σ_c length} / that: the one-sample balance
/// heuristic over channels, by which the weight of channel c never exceeds its integral over its
/// chance.
template <Real F, int channels>
Channels<F, channels> balanced_weights(const Channels<F, channels>& transmittance, F pdf) noexcept {
  const F inverse = select(pdf > F(0), F(1) / select(pdf > F(0), pdf, F(1)), F(0));
  Channels<F, channels> result;
  for (int c = 0; c < channels; ++c) result[c] = transmittance[c] * inverse;
  return result;
}

/// Where samples go along a ray: the pair of a sample and its density.
///
///     placed = placement.on(section, strength)   strength: what a metre of channel c scatters to
///     the camera placed.sample(u)                           t in [0, t_max], monotone in u within
///     a channel  [m] placed.pdf(t, length)                      its density; length is that of the
///     way through p(t)  [1/m] placed.weights(t, length)                  e^{−σ_c length} / pdf for
///     each channel  [m]
template <class P>
concept Placement = requires {
  { P::name } -> std::convertible_to<const char*>;
  { P::meaning } -> std::convertible_to<const char*>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
