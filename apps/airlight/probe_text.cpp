#include <fmt/format.h>

#include <iterator>

#include "numbers_text.h"
#include "probe.h"

namespace {

using namespace airlight;

std::string shown(const Vec3<double>& v) { return text(v, 5); }
std::string shown(const Rgb<double>& c) { return text(c, 6); }

class Writer {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void sums(const char* indent, const Estimate<double>& mean) {
    line("{}plain {}  analytic {}  occluded {}  unoccluded {}", indent, shown(mean.plain),
         shown(mean.analytic), shown(mean.occluded), shown(mean.unoccluded));
  }

  void ray(const ProbedRay& ray, std::size_t index, const Scene& scene) {
    line("");
    line("ray {}: from {} along {}, {} samples", index, shown(ray.origin), shown(ray.direction),
         ray.sample_count);
    line("  # what it meets; only the part in the medium, up to a surface, scatters light into it");
    if (!ray.hit)
      line("  meets no surface");
    else if (ray.end == ray.hit)
      line("  meets {} at {:.6g} m", name(ray.object, scene), *ray.hit);
    else
      line("  meets {} at {:.6g} m, which lets light through, and {}", name(ray.object, scene),
           *ray.hit, ray.end ? fmt::format("ends at {:.6g} m", *ray.end) : "goes on");
    if (ray.t_enter)
      line("  in the medium from {:.6g} m to {:.6g} m", *ray.t_enter, ray.t_exit);
    else
      line("  does not cross the medium");
    line("  passes from its end to the camera: {}", shown(ray.through));
    line("  surfaces and background add {} W/(m2 sr), emission {}", shown(ray.surface),
         shown(ray.emission));
    for (const ProbedLight& one : ray.lights) light(one);
  }

  void light(const ProbedLight& light) {
    line("");
    if (light.in_pieces) {
      line("  lights.{}: comes from {}; E = {} W/m2", light.light, shown(light.toward),
           shown(light.strength));
      line("    the integral of sigma_s p times transmittance = {} /sr",
           shown(light.transmittance_integral));
    } else {
      line("  lights.{}: comes from {}; sigma_s p E = {} W/(m3 sr)", light.light,
           shown(light.toward), shown(light.strength));
      line("    # what a metre of ray would send to the camera, were there no medium in the way");
      line("    T, the integral of transmittance, = {} m", shown(light.transmittance_integral));
      line("    # the length of a ray without extinction that would send as much, were it all lit");
    }
    line("    trapezoids between   t [m]        way to the light [m]   optical depth");
    line("    # between these points the way to the camera and to the light has straight pieces");
    for (const ProbedNode& node : light.nodes)
      line("                         {:<12.6g} {:<22.6g} {}", node.t, node.length,
           shown(node.optical_depth));
    std::string lit;
    for (const auto& [from, to] : light.lit)
      lit += fmt::format("{}{:.4g} to {:.4g} m", lit.empty() ? "" : ", ", from, to);
    line("    lit: {}", lit.empty() ? "nowhere" : lit);
    if (!light.samples.empty()) {
      line("    sample   t [m]        pdf [1/m]    visibility   weight [{}]",
           light.in_pieces ? "1/sr" : "m");
      line("    # each asks one shadow ray; weight = what would arrive there / pdf");
    }
    for (const ProbedSample& s : light.samples)
      line("    {:<8} {:<12.6g} {:<12.6g} {:<12} {}", s.index, s.t, s.pdf, shown(s.visibility),
           shown(s.weight));
    sums("    means: ", light.mean);
    line("    # in-scatter = plain + analytic x occluded / unoccluded");
    line("    in-scatter {} W/(m2 sr)", shown(light.mean.radiance()));
  }

  std::string take() { return std::move(text_); }

 private:
  static std::string name(std::size_t object, const Scene& scene) {
    const std::string& given = scene.objects[object].name;
    return given.empty() ? fmt::format("objects.{}", object) : fmt::format("\"{}\"", given);
  }

  std::string text_;
};

}  // namespace

std::string probe_text(const Probe& probe, const Scene& scene, std::optional<std::size_t> ray) {
  Writer writer;
  writer.line("pixel {},{} by {} in double, {} camera ray{}; t counts from the camera", probe.x,
              probe.y, probe.estimator, probe.rays.size(), probe.rays.size() == 1 ? "" : "s");
  if (probe.max_depth > 1)
    writer.line(
        "# shows light that scatters once; the picture also has what scatters up to {} times",
        probe.max_depth);
  for (std::size_t i = 0; i < probe.rays.size(); ++i)
    if (i == ray.value_or(i)) writer.ray(probe.rays[i], i, scene);
  writer.line("");
  writer.line("pixel");
  writer.line("  # sums are averaged over all rays and lights before the quotient is formed");
  writer.sums("  means: ", probe.mean);
  writer.line("  in-scatter {} + surface {} = radiance {} W/(m2 sr)", shown(probe.in_scatter),
              shown(probe.surface), shown(probe.radiance));
  return writer.take();
}
