#include <fmt/format.h>

#include <iterator>

#include "probe.h"

namespace {

using namespace airlight;

std::string text(const Vec3<double>& v) {
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", v.x + 0., v.y + 0., v.z + 0.);  // no −0
}

/// One number where the channels are equal.
std::string text(const Rgb<double>& c) {
  if (c.r == c.g && c.g == c.b) return fmt::format("{:.6g}", c.r);
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", c.r, c.g, c.b);
}

class Writer {
 public:
  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void sums(const char* indent, const Estimate<double>& mean) {
    line("{}plain {}  analytic {}  occluded {}  unoccluded {}", indent, text(mean.plain),
         text(mean.analytic), text(mean.occluded), text(mean.unoccluded));
  }

  void ray(const ProbedRay& ray, std::size_t index, const Scene& scene) {
    line("ray {}: from {} along {}, {} samples", index, text(ray.origin), text(ray.direction),
         ray.sample_count);
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
    line("  passes from its end to the camera: {}", text(ray.through));
    line("  surfaces and background add {} W/(m2 sr), emission {}", text(ray.surface),
         text(ray.emission));
    for (const ProbedLight& one : ray.lights) light(one);
  }

  void light(const ProbedLight& light) {
    if (light.in_pieces) {
      line("  lights.{}: comes from {}; E = {} W/m2", light.light, text(light.toward),
           text(light.strength));
      line("    the integral of sigma_s p times transmittance = {} /sr",
           text(light.transmittance_integral));
    } else {
      line("  lights.{}: comes from {}; sigma_s p E = {} W/(m3 sr)", light.light,
           text(light.toward), text(light.strength));
      line("    T, the integral of transmittance, = {} m", text(light.transmittance_integral));
    }
    line("    trapezoids between   t [m]        way to the light [m]   optical depth");
    for (const ProbedNode& node : light.nodes)
      line("                         {:<12.6g} {:<22.6g} {}", node.t, node.length,
           text(node.optical_depth));
    std::string lit;
    for (const auto& [from, to] : light.lit)
      lit += fmt::format("{}{:.4g} to {:.4g} m", lit.empty() ? "" : ", ", from, to);
    line("    lit: {}", lit.empty() ? "nowhere" : lit);
    if (!light.samples.empty())
      line("    sample   t [m]        pdf [1/m]    visibility   weight [{}]",
           light.in_pieces ? "1/sr" : "m");
    for (const ProbedSample& s : light.samples)
      line("    {:<8} {:<12.6g} {:<12.6g} {:<12} {}", s.index, s.t, s.pdf, text(s.visibility),
           text(s.weight));
    sums("    means: ", light.mean);
    line("    in-scatter {} W/(m2 sr)", text(light.mean.radiance()));
  }

  std::string take() { return std::move(text_); }

 private:
  static std::string name(std::size_t object, const Scene& scene) {
    const std::string& given = scene.objects[object].name;
    return given.empty() ? fmt::format("objects.{}", object) : fmt::format("\"{}\"", given);
  }

  std::string text_;

  template <class T>
  static std::string text(const T& value) {
    return ::text(value);
  }
};

}  // namespace

std::string probe_text(const Probe& probe, const Scene& scene, std::optional<std::size_t> ray) {
  Writer writer;
  writer.line("pixel {},{} by {} in double, {} camera ray{}; t counts from the camera", probe.x,
              probe.y, probe.estimator, probe.rays.size(), probe.rays.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < probe.rays.size(); ++i)
    if (i == ray.value_or(i)) writer.ray(probe.rays[i], i, scene);
  writer.line("pixel");
  writer.sums("  means: ", probe.mean);
  writer.line("  in-scatter {} + surface {} = radiance {} W/(m2 sr)", text(probe.in_scatter),
              text(probe.surface), text(probe.radiance));
  return writer.take();
}
