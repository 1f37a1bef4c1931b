#pragma once
/// Which samples of a ray ask which light.
#include <vector>

#include "render/frame.h"

namespace airlight {

/// By what a light is picked where a sample asks one light only.
template <Real F, class Space, DrawsPoints<F> Points>
F light_weight(const Frame& frame, const Space& space, const MediumRay<F>& ray,
               const Points& sampler, int index) noexcept {
  if (frame.light_selection == LightSelection::uniform) return F(1);
  const Medium& medium = frame.scene.media[0];
  return std::visit(
      [&](const auto& light) {
        return is_grey(medium, space)
                   ? Sampled::unoccluded<1>(medium, space, light, index, ray, sampler)
                   : Sampled::unoccluded<3>(medium, space, light, index, ray, sampler);
      },
      frame.scene.lights[std::size_t(index)]);
}

/// Calls add(index, share) for every light; the share is null where every sample asks every light.
/// `weights` has room for a number a light.
template <Real F, class Space, DrawsPoints<F> Points, class Add>
void for_each_light_share(const Frame& frame, const Space& space, const MediumRay<F>& ray,
                          const Points& sampler, std::vector<F>& weights, Add&& add) noexcept {
  const bool all = frame.light_selection == LightSelection::all;
  const int lights = int(frame.scene.lights.size());
  LightShare<F> share{F(0), F(0), F(0)};
  for (int i = 0; i < lights && !all; ++i) {
    weights[std::size_t(i)] = light_weight(frame, space, ray, sampler, i);
    share.total = share.total + weights[std::size_t(i)];
  }
  for (int i = 0; i < lights; ++i) {
    share.weight = weights[std::size_t(i)];
    add(i, all ? nullptr : &share);
    share.below = share.below + share.weight;
  }
}

}  // namespace airlight
