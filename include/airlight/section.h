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
  /// What is known of a point of the ray: the length of the whole way through it.  [m]
  using Point = F;

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

  /// A distance with density e^{−σ length} / T of the channel picked, lane by lane.
  template <class Pick>
  F draw(const Pick& pick) const noexcept {
    if constexpr (channels == 1) {
      return trapezoids[0].sample(way, pick.u);
    } else {
      // The trapezoids of the channel drawn, put together lane by lane: one inversion instead of
      // three.
      Trapezoids<F, max_segments> drawn;
      const auto of = [&](auto member) {
        return pick.of({member(trapezoids[0]), member(trapezoids[1]), member(trapezoids[2])});
      };
      drawn.total = of([](const auto& t) { return t.total; });
      for (int i = 0; i < 1 || i < way.segments; ++i) {  // one segment at least
        using Inverse = typename Trapezoids<F, max_segments>::Inverse;
        for (F Inverse::*number :
             {&Inverse::begin, &Inverse::stretch, &Inverse::offset, &Inverse::rate})
          drawn.inverse[i].*number = of([&](const auto& t) { return t.inverse[i].*number; });
      }
      return drawn.sample(way, pick.u);
    }
  }

  /// The density of `draw` in the first channel.  [1/m]
  F density(F length) const noexcept { return trapezoids[0].pdf(length, sigma_t[0]); }

  /// The part of `integral` between two points of the ray.
  Channels<F, channels> integral_between(F from, F to) const noexcept {
    const auto part = way.clipped(from, to);
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c)
      result[c] = Trapezoids<F, max_segments>(part, sigma_t[c]).transmittance_integral();
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
