#pragma once
#include <array>

#include "math/exponential_sum.h"
#include "shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A value a channel of extinction: one where the medium is grey, three in RGB.
template <class T, int channels>
using Channels = std::array<T, channels>;

/// The part of a camera ray that lies in the medium, and one direction light comes from: all that a
/// placement of samples may know. t counts from the entry.
template <Real F, int channels_, class Space>
struct Section {
  static constexpr int channels = channels_;
  static constexpr int max_segments = Space::max_segments;
  using Outward = typename Space::template Outward<F>;
  /// What is known of a point of the ray: the length of the whole way through it.  [m]
  using Point = F;

  const Space& space;
  LocalRay<F> ray;  ///< from the entry, in the shape's coordinates
  Vec3<F> w;        ///< towards the light, in the shape's coordinates
  Outward outward;
  F t_max;                        ///< the length of the section, >= 0  [m]
  Channels<F, channels> sigma_t;  ///< [1/m]
  WayOut<F, max_segments> way;
  Channels<Trapezoids<F, max_segments, channels == 1>, channels> trapezoids;
  Channels<F, channels> integral;  ///< T, of transmittance along the whole section  [m]

  Section(const Space& space_, const LocalRay<F>& ray_, Vec3<F> w_, F t_max_,
          const Channels<F, channels>& sigma_t_) noexcept
      : space(space_),
        ray(ray_),
        w(w_),
        outward(space_.outward(w_)),
        t_max(t_max_),
        sigma_t(sigma_t_) {}

  /// Finds the way out and its trapezoids. Only a march that intersects the shape at every step
  /// does without.
  void trace_way_out() noexcept {
    way = space.way_out(ray, outward, t_max);
    for (int c = 0; c < channels; ++c) {
      trapezoids[c] = {way, sigma_t[c]};
      integral[c] = trapezoids[c].transmittance_integral();
    }
  }

  /// The point at t.
  F at(F t) const noexcept { return way.length_at(t); }

  /// The same without the way out, by intersecting the shape there; light starts `reach` away.
  F intersected(F t, F reach) const noexcept {
    return t + min(space.clip(LocalRay<F>{ray(t), w}).t_exit, reach);
  }

  /// e^{−σ length} for each channel.
  Channels<F, channels> transmittance(F length) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = exp(-sigma_t[c] * length);
    return result;
  }

  /// What reaches the camera of what is scattered at a point, but for what is the same all along
  /// the ray.
  Channels<F, channels> reaching(F length) const noexcept { return transmittance(length); }

  /// What makes `draw` pick channel c with this chance.  [1/m]
  Channels<F, channels> shares(const Channels<F, channels>& chance) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) {
      const F total = trapezoids[c].total;
      result[c] = select(total > F(0), chance[c] / max(total, F(1e-30f)), F(0));
    }
    return result;
  }

  /// A distance with density Σ_c share_c e^{depth_c − σ_c length}: its distribution function
  /// inverted, monotone in u in [0, 1].
  F draw(const Channels<F, channels>& share, F u) const noexcept {
    if constexpr (channels == 1) {
      return trapezoids[0].sample(way, u);
    } else {
      PiecePick<F> pick(u);  // all segments hold 1 together
      F t0 = way.t[0], t1 = way.t[1], from = way.length[0], to = way.length[1];
      ExponentialSum<F, channels> density;
      for (int c = 0; c < channels; ++c) {
        density.begin[c] = trapezoids[c].transmittance[0];
        density.end[c] = trapezoids[c].transmittance[1];
      }
      for (int i = 0; i < max_segments && i < way.segments; ++i) {
        F mass(0);
        for (int c = 0; c < channels; ++c) mass = fma(share[c], trapezoids[c].integral[i], mass);
        const Mask<F> reached = pick.reaches(mass);
        if (i == 0) continue;
        t0 = select(reached, way.t[i], t0), t1 = select(reached, way.t[i + 1], t1);
        from = select(reached, way.length[i], from), to = select(reached, way.length[i + 1], to);
        for (int c = 0; c < channels; ++c) {
          const auto& transmittance = trapezoids[c].transmittance;
          density.begin[c] = select(reached, transmittance[i], density.begin[c]);
          density.end[c] = select(reached, transmittance[i + 1], density.end[c]);
        }
      }
      const F width = t1 - t0;
      for (int c = 0; c < channels; ++c) {
        density.begin[c] = density.begin[c] * share[c] * width;
        density.end[c] = density.end[c] * share[c] * width;
        density.drop[c] = sigma_t[c] * (to - from);
      }
      density.whole = pick.mass();
      return clamp(fma(density.fraction(pick.part()), width, t0), t0, t1);
    }
  }

  /// The density of `draw` in the first channel.  [1/m]
  F density(F length) const noexcept { return trapezoids[0].pdf(length, sigma_t[0]); }

  /// The part of `integral` between two points of the ray.
  Channels<F, channels> integral_between(F from, F to) const noexcept {
    const auto part = way.clipped(from, to);
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c)
      result[c] = Trapezoids<F, max_segments, false>(part, sigma_t[c]).transmittance_integral();
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
