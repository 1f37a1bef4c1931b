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

/// A channel drawn by u, lane by lane, and u made uniform in [0, 1] again: one number serves both,
/// and strata stay strata. Every other channel runs backwards, so that what is drawn depends on u
/// without a jump from one channel to the next: in RGB fog that halves the noise.
template <Real F, int channels>
struct ChannelPick {
  F u;
  std::array<Mask<F>, channels> is;  ///< the last that holds is the channel drawn

  ChannelPick(const Channels<F, channels>& chance, F u_) noexcept : u(u_) {
    if constexpr (channels > 1) {
      F below(0), begin(0), width = chance[0];
      Mask<F> backwards = u_ < F(0);
      for (int c = 1; c < channels; ++c) {
        below = below + chance[c - 1];
        is[c] = (u_ >= below) & (chance[c] > F(0));
        begin = select(is[c], below, begin);
        width = select(is[c], chance[c], width);
        backwards = c % 2 == 1 ? (backwards | is[c]) : (backwards & (u_ < below));
      }
      u = clamp((u_ - begin) / select(width > F(0), width, F(1)), F(0), F(1));
      u = select(backwards, F(1) - u, u);
    }
  }

  /// The value of the channel drawn.
  F of(const Channels<F, channels>& values) const noexcept {
    F result = values[0];
    for (int c = 1; c < channels; ++c) result = select(is[c], values[c], result);
    return result;
  }
};

/// Σ_j chance_j · density_j, and the weights of what reaches the camera over that: the one-sample
/// balance heuristic over channels, by which the weight of channel c never exceeds its integral
/// over its chance.
template <Real F, int channels>
Channels<F, channels> balanced_weights(const Channels<F, channels>& reaching, F pdf) noexcept {
  const F inverse = select(pdf > F(0), F(1) / select(pdf > F(0), pdf, F(1)), F(0));
  Channels<F, channels> result;
  for (int c = 0; c < channels; ++c) result[c] = reaching[c] * inverse;
  return result;
}

/// Where samples go along a ray: the pair of a sample and its density.
///
///     placed = placement.on(section, strength)   strength: what a metre scatters, by channel
///     placed.sample(u)           t in [0, t_max], monotone in u within a channel  [m]
///     placed.pdf(t, at)          its density; at = section.at(t)  [1/m]
///     placed.weights(t, at)      section.reaching(at) / pdf for each channel  [m]
template <class P>
concept Placement = requires {
  { P::name } -> std::convertible_to<const char*>;
  { P::meaning } -> std::convertible_to<const char*>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
