#pragma once
#include <airlight/section_in_pieces.h>

#include "gather.h"
#include "rays_in_a_box.h"

namespace airlight::test {

/// Kinds of rays where the ray and the light all but span no plane.
inline constexpr Kind nearly_parallel[] = {Kind::nearly_into_the_light, Kind::barely_off_the_light,
                                           Kind::light_nearly_behind};

/// A ray that starts inside the box or outside, and ends anywhere.
inline BoxRay any_ray(Random& random, Kind kind) {
  BoxRay ray = ray_of(kind, random);
  if (random.below(2)) ray.o = ray.o - ray.d * random.uniform(0, 3);
  ray.t_max = random.uniform(0.5, 5);
  return ray;
}

/// One light in so many starts at a plane, ahead of all of the ray.
inline LightStart<double> any_start(Random& random, const BoxRay& ray, int one_in) {
  if (random.below(one_in) > 0) return {};
  const double b = -dot(ray.d, ray.w);
  return {std::max(0., -b * ray.t_max) + random.uniform(0, 1.5), b};
}

/// A ray, its end too, of numbers that floats hold.
inline BoxRay in_floats(const BoxRay& ray) {
  return {narrowed(ray.o), narrowed(ray.d), narrowed(ray.w), narrowed(ray.t_max)};
}

/// The section of a packet of rays, one a lane; the last ray fills it up.
template <Real F, int channels, class Space>
Section<F, channels, Space> section_of(const Space& space, const std::vector<BoxRay>& rays,
                                       const Medium& medium) {
  Section<F, channels, Space> section(
      space, {space.point(gather3<F>(rays, 0, &BoxRay::o)), gather3<F>(rays, 0, &BoxRay::d)},
      gather3<F>(rays, 0, &BoxRay::w), gather<F>(rays, 0, &BoxRay::t_max), medium);
  section.trace_way_out();
  return section;
}

/// The same ray in every lane.
template <Real F, int channels, class Space>
Section<F, channels, Space> section_of(const Space& space, const BoxRay& ray,
                                       const Medium& medium) {
  return section_of<F, channels>(space, std::vector{ray}, medium);
}

}  // namespace airlight::test
