#pragma once
#include "estimators.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A packet of rays from the camera to where something opaque ends them.
template <Real F>
struct CameraRay {
  Vec3<F> origin;         ///< [m]
  Vec3<F> direction;      ///< unit length
  F t_max = F(far_away);  ///< to the surface; far away without one  [m]
};

/// The part of a camera ray that lies in a shape.
template <Real F, class Space>
MediumRay<F> medium_ray(const Space& space, const CameraRay<F>& ray) noexcept {
  LocalRay<F> local{space.point(ray.origin), space.vector(ray.direction)};
  const Interval<F> inside = space.clip(local);
  const F t_max = max(min(inside.t_exit, ray.t_max) - inside.t_enter, F(0));
  const Mask<F> meets = t_max > F(0);
  local.o = select(meets, local(inside.t_enter), Vec3<F>());
  return {.origin = ray.origin,
          .direction = ray.direction,
          .entry = local,
          .t_enter = select(meets, inside.t_enter, F(0)),
          .t_max = t_max,
          .active = meets};
}

/// Calls add(space, ray, channels) with what an estimator needs of a medium and a camera ray;
/// `channels` is an integral constant.
template <Real F, class Add>
void with_medium_ray(const Medium& medium, const CameraRay<F>& camera, Add&& add) noexcept {
  std::visit(
      [&](const Shape auto& shape) {
        const auto space = shape.space();
        const MediumRay<F> ray = medium_ray(space, camera);
        if (medium.is_grey())
          add(space, ray, std::integral_constant<int, 1>());
        else
          add(space, ray, std::integral_constant<int, 3>());
      },
      medium.shape);
}

/// What a medium scatters once from a light into a camera ray, estimated with samples 0 to
/// samples − 1 of the sampler: the one call for a program that has a renderer of its own. Estimates
/// of several rays, lights or sample ranges of one pixel are added before `radiance()` is asked of
/// the sum. Ask `estimator.unsupported(medium, light)` first.  [W/(m² sr)]
template <Real F, AnswersVisibility<F> W>
Estimate<F> in_scatter(const Sampled& estimator, const Medium& medium, const Directional& light,
                       const CameraRay<F>& camera, std::uint32_t samples, const Sampler<F>& sampler,
                       const W& world, int light_index = 0) noexcept {
  Halves<F> sums;
  with_medium_ray(medium, camera, [&](const auto& space, const MediumRay<F>& ray, auto channels) {
    estimator.template add<channels()>(medium, space, light, light_index, ray, {0, samples}, false,
                                       sampler, world, sums);
  });
  sums[0] += sums[1];
  return sums[0] * F(Scalar<F>(1) / Scalar<F>(samples));
}

/// The same in closed form, exact. `world` tells which parts of the ray are lit; `Unshadowed{}`
/// says all.  [W/(m² sr)]
template <class W>
Rgb<double> in_scatter(const ClosedForm& estimator, const Medium& medium, const Directional& light,
                       const CameraRay<double>& camera, const W& world,
                       int light_index = 0) noexcept {
  Halves<double> sums;
  with_medium_ray(medium, camera,
                  [&](const auto& space, const MediumRay<double>& ray, auto channels) {
                    estimator.template add<channels()>(medium, space, light, light_index, ray,
                                                       {0, 1}, false, world, sums);
                  });
  return sums[0].plain + sums[1].plain;
}

}  // namespace airlight::inline AIRLIGHT_ISA
