#pragma once
#include "../lit_part.h"
#include "../never_arrives.h"

namespace airlight::inline AIRLIGHT_ISA {

/// The exact radiance for parallel light, from far away or in a beam: the closed form summed over
/// the parts of the camera ray that are lit. It asks the world where those are, `world.lit(origin,
/// direction, t_max, light, sink)` with sink(t_from, t_to).
struct ClosedForm {
  static constexpr auto name = "closed_form";
  static constexpr auto meaning =
      "the exact radiance of parallel light among opaque objects; no noise";

  const char* unsupported(const Medium& medium, const Lights& light) const noexcept {
    if (const char* reason = never_arrives(medium, light)) return reason;
    if (const auto* sun = std::get_if<Directional>(&light); sun && sun->angular_diameter > 0)
      return "closed_form is for parallel light: set angular_diameter = 0";
    if (const auto* beam = std::get_if<Collimated>(&light); beam && beam->image >= 0)
      return "closed_form is for beams without an image; give the beam another outline instead";
    return nullptr;
  }

  template <int channels, class Space, ParallelLight L, class W>
  void add(const Medium& medium, const Space& space, const L& light, int light_index,
           const MediumRay<double>& whole_ray, SampleRange samples, bool halve_by_ray,
           const W& world, Halves<double>& sums) const noexcept {
    const auto lit_by = lit_part(light, medium, space, whole_ray);
    const MediumRay<double>& ray = lit_by.ray;
    if (!ray.active) return;
    const Vec3<double> w = light.toward();
    auto section = section_along<double, channels>(medium, lit_by.space, ray, space.vector(w));
    section.trace_way_out();
    Channels<double, channels> lit{};
    const Vec3<double> entry = ray.origin + ray.direction * ray.t_enter;
    world.lit(entry, ray.direction, ray.t_max, light_index, [&](double from, double to) {
      const auto part = section.integral_between(from, to);
      for (int c = 0; c < channels; ++c) lit[c] += part[c];
    });
    const Rgb<double> radiance = strength_along<Space>(medium, light.irradiance) * ray.dimmed *
                                 to_rgb<double>(lit) *
                                 phase_along<Space>(medium, dot(w, ray.direction));
    for (std::uint32_t i = samples.first; i < samples.first + samples.count; ++i)
      sums[half_of(halve_by_ray ? ray.index : i)].plain += radiance;
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
