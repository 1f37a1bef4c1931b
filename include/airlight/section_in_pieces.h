#pragma once
#include "math/sort.h"
#include "medium.h"
#include "pieces.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What a section asks of a space in pieces.
///
///     Space::one_medium                         whether pieces hold lengths, for one medium fills
///                                               all
///     Space::most_stretches                     that a ray may have inside
///     space.stretches(ray, medium)              the ray's own stretches inside
///     space.cut(ray, w, t_max, inside, pieces)  fills the pieces for light from w
///     space.seen(ray, t, w, inside)             a point of them, without the others
///     Space::set_scale(pieces, inside, cosine)  what their numbers are multiples of
///
/// The space of a shape, too, lets light start at a plane: a `LightStart` more for cut and seen.
template <class Space, class F, int channels>
concept CutsInPieces = InPieces<Space> &&
    requires(const Space space, const LocalRay<F> ray, const Medium medium, Vec3<F> w, F t,
             const typename Space::template StretchesOf<F> inside,
             typename Space::template PiecesOf<F, channels> pieces) {
  { Space::one_medium } -> std::convertible_to<bool>;
  { Space::most_stretches } -> std::convertible_to<int>;
  { space.stretches(ray, medium) } -> std::same_as<typename Space::template StretchesOf<F>>;
  space.template cut<channels>(ray, w, t, inside, pieces);
  { space.template seen<channels>(ray, t, w, inside) } -> std::same_as<decltype(pieces.at(t))>;
  Space::set_scale(pieces, inside, t);
};

/// A section of a camera ray through media whose optical depth is linear in pieces. It answers what
/// `Section` does elsewhere; what scatters is part of it, as it changes along the ray.
template <Real F, int channels_, InPieces Space>
struct Section<F, channels_, Space> {
  static_assert(CutsInPieces<Space, F, channels_>);
  static constexpr int channels = channels_;
  using Inside = typename Space::template StretchesOf<F>;
  using Cut = typename Space::template PiecesOf<F, channels>;
  using Point = typename Cut::Point;

  const Space& space;
  LocalRay<F> ray;  ///< from the entry, in the space's coordinates
  Vec3<F> w;        ///< towards the light, in the space's coordinates
  F t_max;          ///< the length of the section, >= 0  [m]
  Inside inside;    ///< the ray's own stretches
  Cut pieces;
  Channels<F, channels> integral;  ///< of what scatters and reaches the camera; without irradiance

  Section(const Space& space_, const LocalRay<F>& ray_, Vec3<F> w_, F t_max_,
          const Medium& medium) noexcept
      : space(space_), ray(ray_), w(w_), t_max(t_max_), inside(space_.stretches(ray_, medium)) {}

  void trace_way_out() noexcept {
    space.template cut<channels>(ray, w, t_max, inside, pieces);
    pieces.integrate();
    integral = pieces.whole();
  }

  Point at(F t) const noexcept { return pieces.at(t); }
  Point intersected(F t, F /*reach*/) const noexcept {
    return space.template seen<channels>(ray, t, w, inside);
  }

  Channels<F, channels> transmittance(const Point& at) const noexcept {
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = exp(-at.depth[c]);
    return result;
  }
  Channels<F, channels> reaching(const Point& at) const noexcept {
    Channels<F, channels> result = transmittance(at);
    for (int c = 0; c < channels; ++c) result[c] = at.strength[c] * result[c];
    return result;
  }

  /// The way from the camera alone, in pieces: its transmittance times what scatters.
  auto camera_way() const noexcept {
    constexpr bool one_medium = Space::one_medium;
    Pieces<F, channels, int(std::tuple_size_v<typename Cut::Depths>), 2 * Space::most_stretches + 1>
        camera;
    const F cosine = dot(w, ray.d);
    space.set_scale(camera, inside, cosine);
    F ends[2 * Space::most_stretches];
    F phases[one_medium ? 1 : Space::most_stretches];
    for (int j = 0; j < inside.count; ++j) {
      ends[2 * j] = inside.enter[j], ends[2 * j + 1] = inside.leave[j];
      if constexpr (!one_medium) phases[j] = evaluate(inside.medium(j).phase, cosine);
    }
    sort_lanes(ends, 2 * inside.count);
    camera.t[0] = F(0);
    for (int i = 0; i <= 2 * inside.count; ++i) {
      const bool last = i == 2 * inside.count;
      const F t0 = camera.t[camera.count];
      const F t1 = last ? t_max : clamp(ends[i], t0, t_max);
      if (!any(t1 > t0) && !(last && camera.count == 0)) continue;
      const F middle = fma(t1 - t0, F(0.5), t0);
      typename Cut::Depths from{}, to{}, strength{};
      for (int j = 0; j < inside.count; ++j)
        for (std::size_t k = 0; k < from.size(); ++k) {
          const Medium& medium = inside.medium(j);
          const F sigma(Scalar<F>(one_medium ? 1 : medium.sigma_t[int(k)]));
          const F scatters =
              one_medium ? F(1) : F(Scalar<F>(medium.sigma_s[int(k)])) * phases[one_medium ? 0 : j];
          from[k] = fma(sigma, inside.length_before(j, t0), from[k]);
          to[k] = fma(sigma, inside.length_before(j, t1), to[k]);
          strength[k] = select(inside.holds(j, middle), scatters, strength[k]);
        }
      camera.add(t1, from, to, strength);
    }
    camera.integrate();
    return camera;
  }

  Channels<F, channels> shares(const Channels<F, channels>& chance) const noexcept {
    return pieces.shares(chance);
  }
  F draw(const Channels<F, channels>& share, F u) const noexcept { return pieces.sample(share, u); }
  F density(const Point& at) const noexcept {
    const F total = pieces.total[0];
    return at.strength[0] * exp(min(pieces.depth[0] - at.depth[0], F(0))) /
           select(total > F(0), total, F(1));
  }
  Channels<F, channels> integral_between(F from, F to) const noexcept {
    return pieces.between(from, to);
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
