#pragma once
#include <algorithm>

#include "estimators.h"
#include "media.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Calls add(medium, space, ray, channels) with what an estimator needs of media and a camera ray;
/// `channels` is an integral constant.
template <Real F, class Add>
void with_medium_ray(std::span<const Medium> media, const CameraRay<F>& camera,
                     Add&& add) noexcept {
  with_space(media, [&](const Medium* medium, const auto& space) {
    if (!medium) return;
    const MediumRay<F> ray = medium_ray(camera, space);
    if (is_grey(*medium, space))
      add(*medium, space, ray, std::integral_constant<int, 1>());
    else
      add(*medium, space, ray, std::integral_constant<int, 3>());
  });
}

/// What media scatter once from a light into a camera ray, estimated with samples 0 to
/// samples − 1 of the sampler: the one call for a program that has a renderer of its own. Every
/// four samples share a direction towards a light's disc; no samples give zero. Add the estimates
/// of several lights, and average those of several rays of a pixel, before `radiance()` is asked of
/// the outcome. Ask `estimator.unsupported(medium, light)` first. Several media must be boxes or
/// convex polyhedra that do not overlap, as many as `Joined::fits`; of more, only the first ones
/// are seen. `light_index` tells lights apart: two of the same index share their random numbers.
/// [W/(m² sr)]
template <Real F, ParallelLight L, AnswersVisibility<F> W>
Estimate<F> in_scatter(const Sampled& estimator, std::span<const Medium> media, const L& light,
                       const CameraRay<F>& camera, std::uint32_t samples, const Sampler<F>& sampler,
                       const W& world, int light_index = 0) noexcept {
  Halves<F> sums;
  with_medium_ray(
      media, camera,
      [&](const Medium& medium, const auto& space, const MediumRay<F>& ray, auto channels) {
        const std::uint32_t sharing = light.angular_diameter > 0 ? 4 : samples;
        for (std::uint32_t i = 0; i < samples; i += sharing) {
          MediumRay<F> part = ray;
          part.index = i / sharing;
          estimator.template add<channels()>(medium, space, light, light_index, part,
                                             {i, std::min(sharing, samples - i)}, false, sampler,
                                             world, sums);
        }
      });
  sums[0] += sums[1];
  return sums[0] * F(Scalar<F>(1) / Scalar<F>(std::max(samples, 1u)));
}

/// The same in closed form, exact. `world` tells which parts of the ray are lit; `Unshadowed{}`
/// says all.  [W/(m² sr)]
template <ParallelLight L, class W>
Rgb<double> in_scatter(const ClosedForm& estimator, std::span<const Medium> media, const L& light,
                       const CameraRay<double>& camera, const W& world,
                       int light_index = 0) noexcept {
  Halves<double> sums;
  with_medium_ray(
      media, camera,
      [&](const Medium& medium, const auto& space, const MediumRay<double>& ray, auto channels) {
        estimator.template add<channels()>(medium, space, light, light_index, ray, {0, 1}, false,
                                           world, sums);
      });
  return sums[0].plain + sums[1].plain;
}

/// Of one medium.
template <class E, class... Rest>
auto in_scatter(const E& estimator, const Medium& medium, const Rest&... rest) noexcept {
  return in_scatter(estimator, std::span(&medium, 1), rest...);
}

}  // namespace airlight::inline AIRLIGHT_ISA
