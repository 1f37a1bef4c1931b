#pragma once
#include "../math/rotation.h"
#include "../shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A box, oriented at will: the medium of Velinov 2021.
struct Box {
  Vec3<double> min{-1, -1, -1};  ///< [m]
  Vec3<double> max{1, 1, 1};     ///< [m], above min in every component
  Vec3<double> rotation{0, 0,
                        0};  ///< about x, then y, then z, through the centre of the box  [degrees]

  static constexpr auto name = "box";
  static constexpr auto meaning = "a box between two corners, turned about its centre if asked";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("min", &Box::min, unit::metre, any_number(), "the lower corner before the rotation");
    field("max", &Box::max, unit::metre, any_number(), "the upper corner before the rotation");
    field("rotation", &Box::rotation, unit::degree, any_number(),
          "turn about x, then y, then z, through the centre of the box");
  }

  /// Coordinates in which the box is [-1, 1]^3. Directions are not normalised there, so that t
  /// stays in metres.
  struct Space {
    Vec3<double> centre;
    Vec3<double> rows[3];  ///< of the linear map from the world

    template <Real F>
    Vec3<F> point(Vec3<F> p) const noexcept {
      return vector(p - Vec3<F>(centre));
    }
    template <Real F>
    Vec3<F> vector(Vec3<F> v) const noexcept {
      return {dot(Vec3<F>(rows[0]), v), dot(Vec3<F>(rows[1]), v), dot(Vec3<F>(rows[2]), v)};
    }

    template <Real F>
    Interval<F> clip(const LocalRay<F>& ray) const noexcept {
      Interval<F> inside{F(0), F(far_away)};
      for (int k = 0; k < 3; ++k) {
        const F o = ray.o[k], d = ray.d[k];
        const Mask<F> along = abs(d) < F(1e-30f);  // never leaves this slab, or never enters it
        const F inverse = F(1) / select(along, F(1), d);
        const F ta = (F(-1) - o) * inverse, tb = (F(1) - o) * inverse;
        const F nowhere = select(abs(o) > F(1), F(far_away), F(0));
        inside.t_enter =
            airlight::max(inside.t_enter, select(along, nowhere, airlight::min(ta, tb)));
        inside.t_exit =
            airlight::min(inside.t_exit, select(along, F(far_away), airlight::max(ta, tb)));
      }
      return inside;
    }

    /// The three faces through which light from w enters.
    template <Real F>
    struct Outward {
      Vec3<F> plane, inverse, parallel;  ///< +-1; 1 / w, 0 where parallel; far away where parallel
    };

    template <Real F>
    Outward<F> outward(Vec3<F> w) const noexcept {
      const F least = F(parallel_below<F>) * length(w);
      const auto component = [&](F wk, F& plane, F& inverse, F& parallel) {
        const Mask<F> absent = abs(wk) < least;
        plane = select(wk >= F(0), F(1), F(-1));
        inverse = select(absent, F(0), F(1) / select(absent, F(1), wk));
        parallel = select(absent, F(far_away), F(0));
      };
      Outward<F> out;
      component(w.x, out.plane.x, out.inverse.x, out.parallel.x);
      component(w.y, out.plane.y, out.inverse.y, out.parallel.y);
      component(w.z, out.plane.z, out.inverse.z, out.parallel.z);
      return out;
    }

    static constexpr int max_segments = 3;

    /// The envelope of three lines: sorted by slope, its kinks are where neighbours cross; without
    /// a branch.
    template <Real F>
    WayOut<F, max_segments> way_out(const LocalRay<F>& ray, const Outward<F>& out,
                                    F t_max) const noexcept {
      WayOut<F, max_segments> way;
      way.segments = 3;
      const auto line = [&](int i, F plane, F o, F d, F inverse, F parallel) {
        way.a[i] = fma(plane - o, inverse, parallel);
        way.b[i] = -d * inverse;
      };
      line(0, out.plane.x, ray.o.x, ray.d.x, out.inverse.x, out.parallel.x);
      line(1, out.plane.y, ray.o.y, ray.d.y, out.inverse.y, out.parallel.y);
      line(2, out.plane.z, ray.o.z, ray.d.z, out.inverse.z, out.parallel.z);
      const auto steeper_first = [&](int i, int j) {
        const Mask<F> swap = way.b[i] < way.b[j];
        const F a = select(swap, way.a[j], way.a[i]), b = select(swap, way.b[j], way.b[i]);
        way.a[j] = select(swap, way.a[i], way.a[j]);
        way.b[j] = select(swap, way.b[i], way.b[j]);
        way.a[i] = a, way.b[i] = b;
      };
      steeper_first(0, 1), steeper_first(1, 2), steeper_first(0, 1);
      const auto crossing = [&](int i, int j) {
        const F slope = way.b[i] - way.b[j], rise = way.a[j] - way.a[i];
        const Mask<F> cross = slope > F(0);
        const F never = select(rise >= F(0), F(far_away), F(-far_away));
        return select(cross, rise / select(cross, slope, F(1)), never);
      };
      const F t01 = crossing(0, 1), t12 = crossing(1, 2), t02 = crossing(0, 2);
      way.t[0] = F(0);
      way.t[1] =
          clamp(airlight::min(t01, t02), F(0), t_max);  // where the middle line is never lowest,
      way.t[2] = clamp(airlight::max(t12, t02), way.t[1], t_max);  // both fall on t02
      way.t[3] = t_max;
      way.measure();
      return way;
    }
  };

  Space space() const noexcept {
    const Rotation turn(rotation);
    const Vec3<double> half = (max - min) * 0.5;
    return {
        (min + max) * 0.5,
        {turn.axis(0) * (1 / half.x), turn.axis(1) * (1 / half.y), turn.axis(2) * (1 / half.z)}};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
