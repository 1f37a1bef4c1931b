#pragma once
#include "math/special.h"
#include "shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The stretches of a ray that lie in a medium: one in a convex medium, one for each of several
/// media side by side, some in a concave one. Stretches do not overlap; their order does not
/// matter. What a packet of rays needs of media on its own way, whatever light does: their
/// extinction, their glow, and free flights.
template <Real F, int most, class Medium>
struct Stretches {
  const Medium* media = nullptr;  ///< of the first stretch
  int each_own = 0;               ///< 1: stretch j lies in media[j]; 0: all lie in media[0]
  int count = 0;                  ///< 0 without a medium
  F enter[most], leave[most];     ///< enter <= leave; equal where a ray misses it  [m]

  const Medium& medium(int j) const noexcept { return media[j * each_own]; }

  void add(const Interval<F>& inside) noexcept {
    enter[count] = inside.t_enter;
    leave[count] = max(inside.t_exit, inside.t_enter);
    ++count;
  }

  /// Leaves out what lies before t.
  void begin_at(F t) noexcept {
    for (int j = 0; j < count; ++j) {
      enter[j] = max(enter[j], t);
      leave[j] = max(leave[j], enter[j]);
    }
  }

  /// From the first entry to the last exit; empty where nothing is met.
  Interval<F> hull() const noexcept {
    if (count == 0) return {F(0), F(0)};
    if (count == 1) return {enter[0], leave[0]};
    Interval<F> result{F(far_away), F(0)};
    for (int j = 0; j < count; ++j) {
      const Mask<F> met = leave[j] > enter[j];
      result.t_enter = min(result.t_enter, select(met, enter[j], F(far_away)));
      result.t_exit = max(result.t_exit, select(met, leave[j], F(0)));
    }
    return result;
  }

  /// The part of stretch j before t.  [m]
  F length_before(int j, F t) const noexcept { return max(min(t, leave[j]) - enter[j], F(0)); }

  /// Whether t lies in stretch j; in none that the ray misses, not even where that is put.
  Mask<F> holds(int j, F t) const noexcept {
    return (t >= enter[j]) & (t <= leave[j]) & (leave[j] > enter[j]);
  }

  /// Optical depth from the ray's origin to t.
  Rgb<F> depth(F t) const noexcept {
    Rgb<F> sum;
    for (int j = 0; j < count; ++j) sum += Rgb<F>(medium(j).sigma_t) * length_before(j, t);
    return sum;
  }

  /// e^{−depth}.
  Rgb<F> transmittance(F t) const noexcept {
    return count == 0 ? Rgb<F>(F(1)) : exp_minus(depth(t));
  }

  /// ∫ j e^{−depth} dt from one distance to another, in closed form: what the media glow.
  Rgb<F> emitted(F from, F to) const noexcept {
    Rgb<F> sum;
    for (int j = 0; j < count; ++j) {
      if (medium(j).emission == Rgb<double>()) continue;
      const F begin = clamp(from, enter[j], leave[j]);
      const F length = clamp(to, enter[j], leave[j]) - begin;
      const Rgb<F> sigma(medium(j).sigma_t);
      const Rgb<F> mean(phi(sigma.r * length), phi(sigma.g * length), phi(sigma.b * length));
      sum += Rgb<F>(medium(j).emission) * transmittance(begin) * mean * length;
    }
    return sum;
  }

  /// Extinction and scattering coefficients at t; 0 outside.  [1/m]
  Rgb<F> sigma_t(F t) const noexcept { return coefficient(t, &Medium::sigma_t); }
  Rgb<F> sigma_s(F t) const noexcept { return coefficient(t, &Medium::sigma_s); }

  /// The phase function at t; 0 outside.  [1/sr]
  F phase(F t, F cos_theta) const noexcept {
    F value(0);
    for (int j = 0; j < count; ++j) {
      const Mask<F> here = holds(j, t);
      if (any(here)) value = select(here, evaluate(medium(j).phase, cos_theta), value);
    }
    return value;
  }

  /// A direction of travel after light is scattered at t, drawn from the phase function there.
  Vec3<F> onward(F t, Vec3<F> before, Vec2<F> u) const noexcept {
    Vec3<F> direction = scattered_direction(medium(0).phase, before, u);
    for (int j = 1; j < count * each_own; ++j) {
      const Mask<F> here = holds(j, t);
      if (any(here))
        direction = select(here, scattered_direction(medium(j).phase, before, u), direction);
    }
    return direction;
  }

  /// Where the optical depth reaches a value > 0, for free flights; far away where it never does.
  /// sigma_of(medium) is the extinction that counts, one for each lane.  [m]
  template <class SigmaOf>
  F distance_at(F value, SigmaOf&& sigma_of) const noexcept {
    F t(far_away);
    for (int j = 0; j < count; ++j) {
      if (!any(leave[j] > enter[j])) continue;
      F before(0);  // what earlier stretches take
      for (int k = 0; k < count; ++k)
        if (k != j) before = fma(sigma_of(medium(k)), length_before(k, enter[j]), before);
      const F along = (value - before) / max(sigma_of(medium(j)), F(1e-30f));
      const Mask<F> here = (value > before) & (along <= leave[j] - enter[j]);
      t = select(here, enter[j] + along, t);
    }
    return t;
  }

 private:
  Rgb<F> coefficient(F t, Rgb<double> Medium::*which) const noexcept {
    Rgb<F> value;
    for (int j = 0; j < count; ++j) value = select(holds(j, t), Rgb<F>(medium(j).*which), value);
    return value;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
