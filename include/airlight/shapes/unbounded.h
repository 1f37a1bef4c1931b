#pragma once
#include "../shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A medium without end: it dims what is behind it and glows.
struct Unbounded {
  static constexpr auto name = "unbounded";
  static constexpr auto meaning = "everywhere; a directional light never arrives in it";

  template <class Visitor>
  static constexpr void describe(Visitor&&) {}

  struct Space {
    template <Real F>
    Vec3<F> point(Vec3<F> p) const noexcept {
      return p;
    }
    template <Real F>
    Vec3<F> vector(Vec3<F> v) const noexcept {
      return v;
    }
    template <Real F>
    Interval<F> clip(const LocalRay<F>&) const noexcept {
      return {F(0), F(far_away)};
    }

    template <Real F>
    struct Outward {};

    template <Real F>
    Outward<F> outward(Vec3<F>) const noexcept {
      return {};
    }

    static constexpr int max_segments = 1;

    template <Real F>
    WayOut<F, max_segments> way_out(const LocalRay<F>&, const Outward<F>&, F t_max) const noexcept {
      WayOut<F, max_segments> way;
      way.segments = 1;
      way.a[0] = F(far_away), way.b[0] = F(0);
      way.t[0] = F(0), way.t[1] = t_max;
      way.measure();
      return way;
    }
  };

  Space space() const noexcept { return {}; }
};

}  // namespace airlight::inline AIRLIGHT_ISA
