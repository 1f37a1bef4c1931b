#pragma once
#include "math/special.h"
#include "section.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The optical depth of the way from the camera to a point of its ray and on to where light comes
/// from, and what scatters there, where a medium is no single convex body: linear piece by piece,
/// with jumps between pieces.
///
///     T = ∫ s(t) e^{−τ(t)} dt = e^{−depth} Σ s_i Δt_i e^{−min(τ_i, τ_i')} φ(|τ_i' − τ_i|)
///
/// in each channel; τ_i and τ_i' are the depths at the ends of piece i, s_i what scatters in it.
/// τ and s are kept as multiples of `sigma_t` and `sigma_s`, so that one number does for all
/// channels (depths = 1) where one medium fills the body.
template <Real F, int channels, int depths, int most>
struct Pieces {
  static_assert(depths == 1 || depths == channels);
  using Depths = std::array<F, std::size_t(depths)>;

  Channels<F, channels> sigma_t, sigma_s;
  int count = 0;                  ///< in use by any lane; a lane that needs fewer has empty ones
  F t[most + 1];                  ///< ascending  [m]
  Depths begin[most], end[most];  ///< depths at the ends of a piece, in sigma_t
  Depths strength[most];          ///< of a piece, in sigma_s
  Channels<F, channels> integral[most];  ///< of a piece, relative to e^{−depth}
  Channels<F, channels> total;           ///< their sum
  Channels<F, channels> depth;           ///< the smallest depth where anything scatters

  /// The optical depth of channel c from a number kept of it.
  F depth_of(const Depths& x, int c) const noexcept { return sigma_t[c] * x[kept(c)]; }
  F strength_of(const Depths& x, int c) const noexcept { return sigma_s[c] * x[kept(c)]; }

  /// Adds a piece that ends at t[count + 1].
  void add(F t_end, const Depths& from, const Depths& to, const Depths& scatters) noexcept {
    begin[count] = from, end[count] = to, strength[count] = scatters;
    t[++count] = t_end;
  }

  /// Sets the integrals from the pieces.  Relative error 3e-14 (1 + depth) in double where the
  /// nodes are well-conditioned.
  void integrate() noexcept {
    for (int c = 0; c < channels; ++c) {
      F least(far_away);
      for (int i = 0; i < count; ++i) {
        const F low = min(depth_of(begin[i], c), depth_of(end[i], c));
        const Mask<F> counts = (t[i + 1] > t[i]) & (strength_of(strength[i], c) > F(0));
        least = select(counts, min(least, low), least);
      }
      depth[c] = select(least < F(far_away), least, F(0));
      total[c] = F(0);
      for (int i = 0; i < count; ++i) {
        integral[i][c] = mean_of(i, c, begin[i], end[i]) * (t[i + 1] - t[i]);
        total[c] = total[c] + integral[i][c];
      }
    }
  }

  /// T of each channel.
  Channels<F, channels> whole() const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = exp(-depth[c]) * total[c];
    return result;
  }

  /// The part of T between two points of the ray.
  Channels<F, channels> between(F from, F to) const noexcept {
    Channels<F, channels> sum{};
    for (int i = 0; i < count; ++i) {
      const F t0 = clamp(from, t[i], t[i + 1]), t1 = clamp(to, t[i], t[i + 1]);
      const Depths d0 = depths_at(i, t0), d1 = depths_at(i, t1);
      for (int c = 0; c < channels; ++c)
        sum[c] = sum[c] + mean_of(i, c, d0, d1) * max(t1 - t0, F(0));
    }
    for (int c = 0; c < channels; ++c) sum[c] = sum[c] * exp(-depth[c]);
    return sum;
  }

  /// s and τ at a point.
  struct Point {
    Channels<F, channels> strength, depth;
  };

  Point at(F t_) const noexcept {
    Depths near = begin[0], far = end[0], scatters = strength[0];
    F t0 = t[0], t1 = t[1];
    for (int i = 1; i < count; ++i) {
      const Mask<F> here = (t_ >= t[i]) & (t[i + 1] > t[i]);
      t0 = select(here, t[i], t0);
      t1 = select(here, t[i + 1], t1);
      for (int k = 0; k < depths; ++k) {
        near[k] = select(here, begin[i][k], near[k]);
        far[k] = select(here, end[i][k], far[k]);
        scatters[k] = select(here, strength[i][k], scatters[k]);
      }
    }
    const F part = part_of(t0, t1, t_);
    Point result;
    for (int c = 0; c < channels; ++c) {
      const int k = kept(c);
      result.strength[c] = sigma_s[c] * scatters[k];
      result.depth[c] = sigma_t[c] * fma(part, far[k] - near[k], near[k]);
    }
    return result;
  }

  /// What makes `sample` pick channel c with this chance.
  Channels<F, channels> shares(const Channels<F, channels>& chance) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c)
      result[c] = select(total[c] > F(0), chance[c] / max(total[c], F(1e-30f)), F(0));
    return result;
  }

  /// A distance with density Σ_c share_c s_c(t) e^{depth_c − τ_c(t)}: its distribution function
  /// inverted, monotone in u in [0, 1].
  F sample(const Channels<F, channels>& share, F u) const noexcept {
    PiecePick<F> pick(u);  // all pieces hold 1 together
    F t0 = t[0], t1 = t[1];
    Depths from = begin[0], to = end[0], scatters = strength[0];
    for (int i = 0; i < count; ++i) {
      F mass(0);
      for (int c = 0; c < channels; ++c) mass = fma(share[c], integral[i][c], mass);
      const Mask<F> reached = pick.reaches(mass);
      if (i == 0 || !any(reached)) continue;
      t0 = select(reached, t[i], t0);
      t1 = select(reached, t[i + 1], t1);
      for (int k = 0; k < depths; ++k) {
        from[k] = select(reached, begin[i][k], from[k]);
        to[k] = select(reached, end[i][k], to[k]);
        scatters[k] = select(reached, strength[i][k], scatters[k]);
      }
    }
    const F width = t1 - t0;
    ExponentialSum<F, channels> density;
    for (int c = 0; c < channels; ++c) {
      const F x = max(depth_of(from, c) - depth[c], F(0)),
              y = max(depth_of(to, c) - depth[c], F(0));
      const F scale = share[c] * strength_of(scatters, c) * width;
      density.begin[c] = scale * exp(-x), density.end[c] = scale * exp(-y);
      density.drop[c] = y - x;
    }
    density.whole = pick.mass();
    return clamp(fma(density.fraction(pick.part()), width, t0), t0, t1);
  }

 private:
  static constexpr int kept(int c) noexcept { return depths == 1 ? 0 : c; }

  /// The mean of s e^{−(τ − depth)} over a piece between two depths.
  F mean_of(int i, int c, const Depths& from, const Depths& to) const noexcept {
    const F x = max(depth_of(from, c) - depth[c], F(0)), y = max(depth_of(to, c) - depth[c], F(0));
    return strength_of(strength[i], c) * exp(-min(x, y)) * phi(abs(y - x));
  }

  static F part_of(F t0, F t1, F t_) noexcept {
    const F width = t1 - t0;
    return clamp((t_ - t0) / select(width > F(0), width, F(1)), F(0), F(1));
  }

  Depths depths_at(int i, F t_) const noexcept {
    const F part = part_of(t[i], t[i + 1], t_);
    Depths result;
    for (int k = 0; k < depths; ++k) result[k] = fma(part, end[i][k] - begin[i][k], begin[i][k]);
    return result;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
