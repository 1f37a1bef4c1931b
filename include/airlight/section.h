#pragma once
#include <array>

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

  const Space& space;
  LocalRay<F> ray;  ///< from the entry, in the shape's coordinates
  Vec3<F> w;        ///< towards the light, in the shape's coordinates
  Outward outward;
  F t_max;                        ///< the length of the section, >= 0  [m]
  Channels<F, channels> sigma_t;  ///< [1/m]
  WayOut<F, max_segments> way;
  Channels<Trapezoids<F, max_segments>, channels> trapezoids;
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

  /// e^{−σ length} for each channel.
  Channels<F, channels> transmittance(F length) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = exp(-sigma_t[c] * length);
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
