#pragma once
#include "estimator.h"
#include "placement.h"

namespace airlight::inline AIRLIGHT_ISA {

/// How a path goes on from a segment of a homogeneous medium: it is scattered at a point of it, or
/// arrives at its end. A channel c is drawn with chance r_c = β_c / Σβ, then a distance t from
/// σ_c e^{−σ_c t}; with S the length,
///
///     t < S:   β'_k = β_k σ_s,k e^{−σ_k t} / Σ_j r_j σ_j e^{−σ_j t}
///     else:    β'_k = β_k e^{−σ_k S} / Σ_j r_j e^{−σ_j S}
///
/// so that Σβ' <= max_k albedo_k · Σβ or Σβ' <= Σβ at every vertex, whatever the colours of the
/// medium: no product of densities is carried along a path, and none can grow.
template <Real F, int channels>
struct FreeFlight {
  Rgb<F> throughput;  ///< β, of the path so far; >= 0
  F length;           ///< S, >= 0  [m]
  Rgb<F> sigma_s;     ///< [1/m]
  Channels<F, channels> sigma_t;
  Channels<F, channels> chance;

  FreeFlight(const Medium& medium, Rgb<F> throughput_, F length_) noexcept
      : throughput(throughput_),
        length(length_),
        sigma_s(medium.sigma_s),
        sigma_t(extinction<F, channels>(medium)) {
    if constexpr (channels == 1)
      chance = {F(1)};
    else
      chance = chances<F, channels>({throughput.r, throughput.g, throughput.b});
  }

  /// A distance, which may lie beyond the end.  [m]
  F draw(F u) const noexcept {
    const ChannelPick<F, channels> pick(chance, u);
    const F sigma = pick.of(sigma_t);
    return select(sigma > F(0), -log1p_minus(pick.u) / max(sigma, F(1e-30f)), F(2 * far_away));
  }

  /// The chance that `draw` does not lie beyond the end.
  F chance_to_scatter() const noexcept {
    F sum(0);
    for (int c = 0; c < channels; ++c)
      sum = fma(chance[c], one_minus_exp(sigma_t[c] * length), sum);
    return sum;
  }

  /// β' after scattering at a distance drawn.
  Rgb<F> scattered(F t) const noexcept {
    if constexpr (channels == 1)
      return throughput * sigma_s * reciprocal(sigma_t[0]);
    else {
      F pdf(0);
      for (int c = 0; c < channels; ++c)
        pdf = fma(chance[c] * sigma_t[c], exp(-sigma_t[c] * t), pdf);
      return scattered(t, pdf);
    }
  }

  /// β' after scattering at a distance that was drawn otherwise, with density pdf.
  Rgb<F> scattered(F t, F pdf) const noexcept {
    return throughput * sigma_s * extinguished(t) * reciprocal(pdf);
  }

  /// β' at the end of a path that was drawn to arrive there.
  Rgb<F> arrived() const noexcept {
    if constexpr (channels == 1)
      return throughput;
    else {
      F arriving(0);
      for (int c = 0; c < channels; ++c)
        arriving = fma(chance[c], exp(-sigma_t[c] * length), arriving);
      return dimmed() * reciprocal(arriving);
    }
  }

  /// β' at the end of a path that is never scattered.
  Rgb<F> dimmed() const noexcept { return throughput * extinguished(length); }

 private:
  Rgb<F> extinguished(F t) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = exp(-sigma_t[c] * t);
    return to_rgb<F>(result);
  }

  /// 0 where a density underflows: nothing is drawn there.
  static F reciprocal(F pdf) noexcept {
    return select(pdf > F(0), F(1) / select(pdf > F(0), pdf, F(1)), F(0));
  }
};

/// Ends paths that carry little: a path survives with chance min(1, max β / threshold), and carries
/// the more for it. Returns which survive.
template <Real F>
Mask<F> survives_roulette(Rgb<F>& throughput, F threshold, F u) noexcept {
  const F most = max(max(throughput.r, throughput.g), throughput.b);
  const F chance = min(F(1), most / threshold);
  throughput = throughput * (F(1) / max(chance, F(1e-20f)));
  return u < chance;
}

}  // namespace airlight::inline AIRLIGHT_ISA
