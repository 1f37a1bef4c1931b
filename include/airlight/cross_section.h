#pragma once
#include <array>
#include <span>

#include "shape.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Cuts an interval down to where a + b t >= 0; empty if that is nowhere.
template <Real F>
void keep_where_positive(Interval<F>& interval, F a, F b) noexcept {
  const Mask<F> level = abs(b) < F(1e-30f);
  const F zero = -a / select(level, F(1), b);
  const F never = select(a < F(0), F(far_away), F(-far_away));
  interval.t_enter =
      max(interval.t_enter, select(level, never, select(b > F(0), zero, F(-far_away))));
  interval.t_exit = min(interval.t_exit, select(level | (b > F(0)), F(far_away), zero));
}

/// The outline of a beam in the plane across it: a circle about the origin or a convex polygon.
struct CrossSection {
  static constexpr int max_sides = 32;

  /// {p : x p.x + y p.y <= h}, (x, y) of unit length.
  struct Side {
    double x, y, h;
  };

  double radius = 1;   ///< of the circle; not of a polygon  [m]
  int side_count = 0;  ///< 0: a circle
  std::array<Side, max_sides> sides{};
  Vec2<double> low{-1, -1}, high{1, 1};  ///< corners of the rectangle around it  [m]

  static CrossSection circle(double radius) noexcept {
    CrossSection result;
    result.radius = radius;
    result.low = {-radius, -radius}, result.high = {radius, radius};
    return result;
  }

  /// Of the corners of a convex polygon in either sense of rotation, 3 to max_sides of them.
  static CrossSection polygon(std::span<const Vec2<double>> corners) noexcept {
    CrossSection result;
    result.side_count = int(corners.size());
    result.low = result.high = corners[0];
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2<double> p = corners[i], q = corners[(i + 1) % corners.size()];
      area += p.x * q.y - q.x * p.y;
      result.low = {min(result.low.x, p.x), min(result.low.y, p.y)};
      result.high = {max(result.high.x, p.x), max(result.high.y, p.y)};
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2<double> p = corners[i], q = corners[(i + 1) % corners.size()];
      const double x = q.y - p.y, y = p.x - q.x;
      const double outward = (area < 0 ? -1 : 1) / std::sqrt(x * x + y * y);
      result.sides[i] = {x * outward, y * outward, (x * p.x + y * p.y) * outward};
    }
    return result;
  }

  static CrossSection rectangle(double width, double height) noexcept {
    const double x = width / 2, y = height / 2;
    return polygon(std::array<Vec2<double>, 4>{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}});
  }

  /// Where the point p + t v, which moves along a line, is inside. It may stand still.
  template <Real F>
  Interval<F> clip(Vec2<F> p, Vec2<F> v) const noexcept {
    Interval<F> inside{F(-far_away), F(far_away)};
    for (int i = 0; i < side_count; ++i) {
      const F x(Scalar<F>(sides[i].x)), y(Scalar<F>(sides[i].y)), h(Scalar<F>(sides[i].h));
      keep_where_positive(inside, h - (x * p.x + y * p.y), -(x * v.x + y * v.y));
    }
    if (side_count > 0) return inside;
    const F speed2 = v.x * v.x + v.y * v.y;
    const Mask<F> still = speed2 < F(1e-30f);
    const F inverse = F(1) / select(still, F(1), speed2);
    const F middle = select(still, F(0), -(p.x * v.x + p.y * v.y) * inverse);
    const F x = fma(middle, v.x, p.x), y = fma(middle, v.y, p.y);  // nearest to the centre
    const F spare = F(Scalar<F>(radius * radius)) - (x * x + y * y);
    const F half = select(still, F(far_away), sqrt(max(spare, F(0)) * inverse));
    const Mask<F> meets = spare > F(0);
    return {select(meets, middle - half, F(far_away)), select(meets, middle + half, F(-far_away))};
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
