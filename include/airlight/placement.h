#pragma once
#include "section.h"
#include "shapes/unbounded.h"

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

/// A placement on one section of a ray, the pair of a sample and its density: what estimators ask
/// of it.
///
///     placed.sample(u)           t in [0, t_max], monotone in u (in each part of a mix)  [m]
///     placed.pdf(t, at)          its density; at = section.at(t)  [1/m]
///     placed.weights(t, at)      section.reaching(at) / pdf for each channel  [m]
template <class P, class Section, class F = decltype(Section::t_max)>
concept PlacedOn = requires(const P placed, F u, F t, typename Section::Point at) {
  { placed.sample(u) } -> std::same_as<F>;
  { placed.pdf(t, at) } -> std::same_as<F>;
  { placed.weights(t, at) } -> std::same_as<Channels<F, Section::channels>>;
};

/// Where samples go along a ray.
///
///     placement.on(section, strength)   `PlacedOn` the section; strength: what a metre scatters,
///                                       by channel
template <class P>
concept Placement = requires(const P placement, Section<double, 3, Unbounded::Space> section,
                             Channels<double, 3> strength) {
  { P::name } -> std::convertible_to<const char*>;
  { P::meaning } -> std::convertible_to<const char*>;
  { placement.on(section, strength) } -> PlacedOn<Section<double, 3, Unbounded::Space>>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
