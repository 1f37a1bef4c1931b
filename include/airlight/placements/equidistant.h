#pragma once
#include "../placement.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Uniform along the ray: ray marching, when u is stratified (jittered steps of t_max / N).
struct Equidistant {
  static constexpr auto name = "equidistant";
  static constexpr auto meaning = "uniform along the ray: ray marching";

  template <class Section>
  struct On;

  template <class Section, class Strength>
  On<Section> on(const Section& section, const Strength&) const noexcept {
    return {section};
  }
};

template <Real F, int channels, class Space>
struct Equidistant::On<Section<F, channels, Space>> {
  using Point = typename Section<F, channels, Space>::Point;
  const Section<F, channels, Space>& section;

  F sample(F u) const noexcept { return u * section.t_max; }

  F pdf(F, const Point&) const noexcept {
    return F(1) / select(section.t_max > F(0), section.t_max, F(1));
  }

  Channels<F, channels> weights(F, const Point& at) const noexcept {
    Channels<F, channels> w = section.reaching(at);
    for (F& c : w) c = c * section.t_max;
    return w;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
