#pragma once
#include "estimator.h"
#include "placement.h"
#include "stretches.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A channel drawn by u, lane by lane, and u made uniform in [0, 1] again: one number serves both,
/// and strata stay strata. Every other channel runs backwards, so that what is drawn depends on u
/// without a jump from one channel to the next.
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

/// The way of a free flight through one medium that fills it: t counts from where the flight
/// begins.
template <Real F, int channels>
struct EvenWay {
  Rgb<F> scattering;                 ///< [1/m]
  Channels<F, channels> extinction;  ///< [1/m]

  explicit EvenWay(const Medium& medium) noexcept
      : scattering(medium.sigma_s), extinction(airlight::extinction<F, channels>(medium)) {}

  Rgb<F> sigma_s(F) const noexcept { return scattering; }
  Channels<F, channels> sigma_t(F) const noexcept { return extinction; }
  Channels<F, channels> depth(F t) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = extinction[c] * t;
    return result;
  }
  /// Where the depth of the channel picked reaches a value; far away where it never does.  [m]
  template <class Pick>
  F distance_at(F value, const Pick& pick) const noexcept {
    const F sigma = pick.of(extinction);
    return select(sigma > F(0), value / max(sigma, F(1e-30f)), F(2 * far_away));
  }
};

/// The same through the stretches of a ray that lie in media, from a point of the ray on.
template <Real F, class Inside>
struct UnevenWay {
  const Inside& inside;
  F begin;  ///< where on the ray the flight begins; no stretch begins before it  [m]

  Rgb<F> sigma_s(F t) const noexcept { return inside.sigma_s(begin + t); }
  Channels<F, 3> sigma_t(F t) const noexcept { return channels_of(inside.sigma_t(begin + t)); }
  Channels<F, 3> depth(F t) const noexcept { return channels_of(inside.depth(begin + t)); }
  template <class Pick>
  F distance_at(F value, const Pick& pick) const noexcept {
    const auto sigma_of = [&](const auto& medium) { return pick.of(extinction<F, 3>(medium)); };
    return inside.distance_at(value, sigma_of) - begin;
  }

 private:
  static Channels<F, 3> channels_of(const Rgb<F>& c) noexcept { return {c.r, c.g, c.b}; }
};

/// How a path goes on from a segment: it is scattered at a point of the media on it, or arrives at
/// its end. A channel c is drawn with chance r_c = β_c / Σβ, then a distance t from
/// σ_c(t) e^{−τ_c(t)}, τ the optical depth from where the segment begins; with S the length,
///
///     t < S:   β'_k = β_k σ_s,k(t) e^{−τ_k(t)} / Σ_j r_j σ_j(t) e^{−τ_j(t)}
///     else:    β'_k = β_k e^{−τ_k(S)} / Σ_j r_j e^{−τ_j(S)}
///
/// so that Σβ' <= max_k albedo_k(t) · Σβ or Σβ' <= Σβ at every vertex, whatever the colours of the
/// media: no product of densities is carried along a path, and none can grow. Where one medium ends
/// and another begins nothing happens to the path.
template <Real F, int channels, class Way>
struct FreeFlight {
  Way way;
  Rgb<F> throughput;  ///< β, of the path so far; >= 0
  F length;           ///< S, >= 0  [m]
  Channels<F, channels> chance;

  FreeFlight(const Way& way_, Rgb<F> throughput_, F length_) noexcept
      : way(way_), throughput(throughput_), length(length_) {
    if constexpr (channels == 1)
      chance = {F(1)};
    else
      chance = chances<F, channels>({throughput.r, throughput.g, throughput.b});
  }

  /// A distance, which may lie beyond the end.  [m]
  F draw(F u) const noexcept {
    const ChannelPick<F, channels> pick(chance, u);
    return way.distance_at(-log1p_minus(pick.u), pick);
  }

  /// The chance that `draw` does not lie beyond the end.
  F chance_to_scatter() const noexcept {
    const Channels<F, channels> depth = way.depth(length);
    F sum(0);
    for (int c = 0; c < channels; ++c) sum = fma(chance[c], one_minus_exp(depth[c]), sum);
    return sum;
  }

  /// β' after scattering at a distance drawn.
  Rgb<F> scattered(F t) const noexcept {
    const Channels<F, channels> sigma_t = way.sigma_t(t);
    if constexpr (channels == 1)
      return throughput * way.sigma_s(t) * reciprocal(sigma_t[0]);
    else {
      const Channels<F, channels> left = transmittance(t);
      F pdf(0);
      for (int c = 0; c < channels; ++c) pdf = fma(chance[c] * sigma_t[c], left[c], pdf);
      return throughput * way.sigma_s(t) * to_rgb<F>(left) * reciprocal(pdf);
    }
  }

  /// β' after scattering at a distance that was drawn otherwise, with density pdf.
  Rgb<F> scattered(F t, F pdf) const noexcept {
    return throughput * way.sigma_s(t) * to_rgb<F>(transmittance(t)) * reciprocal(pdf);
  }

  /// β' at the end of a path that was drawn to arrive there.
  Rgb<F> arrived() const noexcept {
    if constexpr (channels == 1)
      return throughput;
    else {
      const Channels<F, channels> left = transmittance(length);
      F arriving(0);
      for (int c = 0; c < channels; ++c) arriving = fma(chance[c], left[c], arriving);
      return throughput * to_rgb<F>(left) * reciprocal(arriving);
    }
  }

  /// β' at the end of a path that is never scattered.
  Rgb<F> dimmed() const noexcept { return throughput * to_rgb<F>(transmittance(length)); }

 private:
  /// e^{−τ(t)}.
  Channels<F, channels> transmittance(F t) const noexcept {
    Channels<F, channels> result = way.depth(t);
    for (F& depth : result) depth = exp(-depth);
    return result;
  }

  /// 0 where a density underflows: nothing is drawn there.
  static F reciprocal(F pdf) noexcept {
    return select(pdf > F(0), F(1) / select(pdf > F(0), pdf, F(1)), F(0));
  }
};

/// The flight along the part of a ray in its media, from `begin` on. In one medium that fills the
/// part, one channel does for grey.
template <int channels, Real F, class Inside>
auto free_flight(const Inside& inside, F begin, F length, const Rgb<F>& throughput) noexcept {
  using Way = UnevenWay<F, Inside>;
  return FreeFlight<F, channels, Way>(Way{inside, begin}, throughput, length);
}
template <int channels, Real F>
auto free_flight(const Stretches<F, 1, Medium>& inside, F, F length,
                 const Rgb<F>& throughput) noexcept {
  using Way = EvenWay<F, channels>;
  static constexpr Medium vacuum;
  return FreeFlight<F, channels, Way>(Way(inside.media ? *inside.media : vacuum), throughput,
                                      length);
}

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
