#pragma once
#include <array>

#include "special.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A density over an interval, g in [0, 1] from its begin to its end, that is a sum of
/// exponentials:
///
///     p(g) = Σ_c begin_c e^{−drop_c g},   end_c = begin_c e^{−drop_c}
template <Real F, std::size_t n>
struct ExponentialSum {
  std::array<F, n> begin, end;  ///< values at the ends, >= 0
  std::array<F, n> drop;        ///< of the logarithm from begin to end, of either sign
  F whole;                      ///< ∫ p dg

  /// The g below which the part `part` of the integral lies, in [0, 1] and monotone but for
  /// rounding.
  /// Of one exponential, or of several that are alike, a first guess is right: the exponential
  /// through both ends of p. Each step goes on by the exponential that touches p where the last one
  /// came to, which leaves the cube of an error: drops up to a factor of two apart take one step,
  /// any take four.  Error of the part 1e-14 in double, 3e-6 in float.
  AIRLIGHT_INLINE F fraction(F part) const noexcept {
    constexpr bool precise = std::same_as<F, double>;
    const F tolerance = F(precise ? 2e-6 : 1e-3) * whole,
            rounding = F(precise ? 1e-15 : 5e-7) * whole;
    const F least(1e-30f);
    const F wanted = part * whole;
    F g = guess(part);
    for (int step = 0; step < 8; ++step) {
      F missing = wanted, here(0), falling(0);
      for (std::size_t c = 0; c < n; ++c) {
        const Mask<F> falls = drop[c] >= F(0);
        const F steepness = abs(drop[c]), y = steepness * g;
        const F density = max(begin[c], end[c]) * exp(-select(falls, y, steepness - y));
        F mean = select(falls, begin[c], density) * phi_below_one(min(y, F(1)));
        if (const Mask<F> deep = y > F(1); any(deep))
          mean = select(deep, abs(begin[c] - density) / max(y, F(1)), mean);
        missing = fma(-g, mean, missing);
        here = here + density;
        falling = fma(drop[c], density, falling);
      }
      // A step of missing / here, bent by −log(1 − z) / z with z = missing · falling / here²: its
      // first terms in one quotient.
      const F per_density = F(1) / max(here, least);
      const F straight = select(abs(missing) > rounding, missing, F(0)) * per_density;
      const F z = min(straight * falling * per_density, F(1));
      g = clamp(fma(straight, (F(6) - z) / (F(6) - F(4) * z), g), F(0), F(1));
      if (!any(abs(missing) > tolerance)) break;
    }
    return g;
  }

 private:
  /// The same of the exponential through both ends.
  F guess(F part) const noexcept {
    const F least(1e-30f);
    F first(0), last(0), slowest(far_away);
    for (std::size_t c = 0; c < n; ++c) {
      first = first + begin[c];
      last = last + end[c];
      slowest =
          select((begin[c] + end[c] > F(0)) & (abs(drop[c]) < abs(slowest)), drop[c], slowest);
    }
    const Mask<F> falls = first >= last;
    const F high = select(falls, first, last), low = select(falls, last, first);
    const F lost = F(1) - low / max(high, least);
    const F v = select(falls, part, F(1) - part);
    const F deep = select(low > least, -log1p_minus(lost), abs(slowest));
    const F along = select(lost > F(1e-6f), -log1p_minus(v * lost) / max(deep, F(1e-6f)), v);
    return clamp(select(falls, along, F(1) - along), F(0), F(1));
  }
};

/// Which of the pieces of a distribution holds a point, of which is known how much lies before it.
template <Real F>
class PiecePick {
 public:
  explicit PiecePick(F before) noexcept : before_(before) {}

  /// Is told of one piece after another, with what it holds; says where the point lies in this one
  /// or behind it. The last piece that said so, and held anything, is the one.
  Mask<F> reaches(F mass) noexcept {
    const Mask<F> here = (before_ >= seen_) & (mass > F(0));
    below_ = select(here, seen_, below_);
    mass_ = select(here, mass, mass_);
    seen_ = seen_ + mass;
    return here;
  }

  /// What the piece holds.
  F mass() const noexcept { return mass_; }

  /// The part of the piece that lies before the point.
  F part() const noexcept {
    return clamp((before_ - below_) / select(mass_ > F(0), mass_, F(1)), F(0), F(1));
  }

 private:
  F before_, seen_{F(0)}, below_{F(0)}, mass_{F(0)};
};

}  // namespace airlight::inline AIRLIGHT_ISA
