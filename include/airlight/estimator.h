#pragma once
#include "estimate.h"
#include "lights.h"
#include "math/random.h"
#include "medium.h"
#include "section_in_pieces.h"
#include "world.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Samples first, first + 1, … of a pixel, all on one of its camera rays.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// A packet of rays, from the camera or of a path that began there, and the part of each that lies
/// in the medium.
template <Real F>
struct MediumRay {
  Vec3<F> origin;     ///< of the camera ray, in the world  [m]
  Vec3<F> direction;  ///< unit length
  LocalRay<F> entry;  ///< the ray from its entry on, in the coordinates of the medium's shape
  F t_enter;          ///< [m]
  F t_max;         ///< the length inside, up to the surface or the exit; 0 where there is none  [m]
  Mask<F> active;  ///< lanes with t_max > 0
  Rgb<F> dimmed{F(1)};      ///< what light at the entry is multiplied by on its way to the camera
  std::uint32_t index = 0;  ///< of the ray in its pixel
  bool filtered = false;    ///< whether glass or cut-outs may stand between the camera and t_max
};

/// A packet of rays from the camera to where something opaque ends them.
template <Real F>
struct CameraRay {
  Vec3<F> origin;         ///< [m]
  Vec3<F> direction;      ///< unit length
  F t_max = F(far_away);  ///< to the surface; far away without one  [m]
};

/// The part of a camera ray that lies in a shape: from the ray in the shape's coordinates and the
/// interval inside. Lanes that miss the shape get a section of no length, from a point where
/// nothing overflows.
template <Real F>
MediumRay<F> medium_ray(const CameraRay<F>& ray, const LocalRay<F>& local,
                        const Interval<F>& inside) noexcept {
  const F t_max = max(min(ray.t_max, inside.t_exit) - inside.t_enter, F(0));
  const Mask<F> meets = t_max > F(0);
  return {.origin = ray.origin,
          .direction = ray.direction,
          .entry = {select(meets, local(inside.t_enter), Vec3<F>()), local.d},
          .t_enter = select(meets, inside.t_enter, F(0)),
          .t_max = t_max,
          .active = meets};
}

template <Real F, class Space>
MediumRay<F> medium_ray(const CameraRay<F>& ray, const Space& space) noexcept {
  const LocalRay<F> local{space.point(ray.origin), space.vector(ray.direction)};
  return medium_ray(ray, local, space.clip(local));
}

/// The streams of random numbers a pixel has; each light has its own.
namespace stream {
inline constexpr std::uint32_t camera = 0;
/// How a path goes on: how far, in which direction, off a surface or through it, whether at all.
inline constexpr std::uint32_t flight = 1, direction = 2, side = 3, roulette = 4;
/// Which light's sample a path goes on from.
inline constexpr std::uint32_t light = 5;
inline constexpr std::uint32_t light_choice = 6;  ///< where a sample asks one light only
constexpr std::uint32_t distance(int light) noexcept { return 8u + 4u * std::uint32_t(light); }
constexpr std::uint32_t disc(int light) noexcept { return 9u + 4u * std::uint32_t(light); }
constexpr std::uint32_t surface(int light) noexcept { return 11u + 4u * std::uint32_t(light); }
}  // namespace stream

/// The sums of a pixel in two halves, each sample counting once: divided by their number they are
/// the pixel's `Estimate`.
template <class F>
using Halves = std::array<Estimate<F>, 2>;

/// The extinction of a medium as one or three channels.
template <Real F, int channels>
Channels<F, channels> extinction(const Medium& medium) noexcept {
  Channels<F, channels> sigma_t;
  for (int c = 0; c < channels; ++c) sigma_t[c] = F(Scalar<F>(medium.sigma_t[c]));
  return sigma_t;
}

/// Whether one channel does for all in a medium's space.
template <class Space>
bool is_grey(const Medium& medium, const Space& space) noexcept {
  if constexpr (requires { space.is_grey(); })
    return space.is_grey();
  else
    return medium.is_grey();
}

/// A camera ray's section for light from w, in the space's coordinates.
template <Real F, int channels, class Space>
Section<F, channels, Space> section_along(const Medium& medium, const Space& space,
                                          const MediumRay<F>& ray, Vec3<F> w) noexcept {
  if constexpr (InPieces<Space>)
    return {space, ray.entry, w, ray.t_max, medium};
  else
    return {space, ray.entry, w, ray.t_max, extinction<F, channels>(medium)};
}

/// What of light with this irradiance a metre scatters, and the phase function, as far as they are
/// the same all along a ray: in pieces, the section knows what scatters where.
template <class Space>
Rgb<double> strength_along(const Medium& medium, const Rgb<double>& irradiance) noexcept {
  return InPieces<Space> ? irradiance : medium.sigma_s * irradiance;
}
template <class Space, Real F>
F phase_along(const Medium& medium, F cosine) noexcept {
  return InPieces<Space> ? F(1) : evaluate(medium.phase, cosine);
}

/// One or three channels as a colour.
template <Real F, std::size_t channels>
Rgb<F> to_rgb(const std::array<F, channels>& c) noexcept {
  if constexpr (channels == 1)
    return Rgb<F>(c[0]);
  else
    return {c[0], c[1], c[2]};
}

/// A way to estimate the light that a medium scatters once from a light to the camera. It says what
/// it can't serve with a reason; null: it can.
template <class E>
concept Estimator = requires(const E estimator, const Medium& medium, const Lights& light) {
  { E::name } -> std::convertible_to<const char*>;
  { E::meaning } -> std::convertible_to<const char*>;
  { estimator.unsupported(medium, light) } -> std::same_as<const char*>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
