#include <fmt/format.h>

#include "numbers_text.h"
#include "render/summary.h"
#include "scene_flags.h"
#include "verbs.h"

namespace {

using airlight::Rgb, airlight::Summary;

constexpr const char* examples = R"(Examples:
  airlight info scenes/sunroom.toml
  airlight info model.glb -D render.estimator=closed_form
)";

template <class T>
std::string shown(const T& value) {
  return text(value, 4);
}

std::string bytes(std::size_t n) { return fmt::format("{:.1f} MiB", double(n) / (1 << 20)); }

void print_medium(const std::string& name, const airlight::Medium& medium,
                  const airlight::MediumSummary& fog) {
  fmt::print("{:<10} {}\n", name, fog.shape);
  fmt::print("           the camera is {} the medium\n", fog.camera_inside ? "inside" : "outside");
  fmt::print("           sigma_s {} /m, sigma_t {} /m, albedo {}\n", shown(medium.sigma_s),
             shown(medium.sigma_t), shown(fog.albedo));
  fmt::print("           phase {}\n", fog.phase);
  if (medium.emission != Rgb<double>())
    fmt::print("           emission {} W/(m3 sr)\n", shown(medium.emission));
  fmt::print("           mean free path {} m\n", shown(fog.mean_free_path));
  if (fog.across)
    fmt::print(
        "           optical depth {} across (the longest way through its middle along x, y or z: "
        "{:.4g} m)\n",
        shown(fog.optical_depth), *fog.across);
  if (fog.enter)
    fmt::print("           seen from {:.4g} m to {} along the middle of the picture\n", *fog.enter,
               fog.exit ? fmt::format("{:.4g} m", *fog.exit) : "infinity");
}

/// What only some kinds of light have.
void print_outline(const airlight::Scene&, const airlight::Directional&) {}
void print_outline(const airlight::Scene& scene, const airlight::Collimated& beam) {
  const airlight::CrossSection& outline = beam.cross_section;
  const std::string form =
      outline.side_count == 0
          ? fmt::format("circle of radius {:.4g} m", outline.radius)
          : fmt::format("polygon of {} sides, {:.4g} m x {:.4g} m", outline.side_count,
                        outline.high.x - outline.low.x, outline.high.y - outline.low.y);
  fmt::print("           begins at {} m as a {}\n", shown(beam.position), form);
  if (beam.image < 0) return;
  const airlight::Texture& image = scene.textures[std::size_t(beam.image)];
  fmt::print("           passes through an image of {} x {} pixels\n", image.width, image.height);
}

void print_light(const std::string& name, const airlight::Scene& scene, std::size_t i,
                 const airlight::LightSummary& light) {
  fmt::print("{:<10} {} from {}, irradiance {} W/m2, angular diameter {:.4g} degrees\n", name,
             light.kind, shown(light.toward), shown(light.irradiance), light.angular_diameter);
  std::visit([&](const auto& kind) { print_outline(scene, kind); }, scene.lights[i]);
  if (i < scene.light_groups.size() && !scene.light_groups[i].empty())
    fmt::print("           in the group {}\n", scene.light_groups[i]);
  if (light.lit_part)
    fmt::print("           reaches about {:.3g} % of the fog in the picture\n",
               100 * *light.lit_part);
}

void print(const airlight::Scene& scene, const Summary& summary) {
  fmt::print("objects    {} ({} triangles, {} spheres), {} textures\n", summary.objects,
             summary.triangles, summary.spheres, summary.textures);
  if (summary.holdouts > 0)
    fmt::print("           {} of them holdouts, which show {} in their place\n", summary.holdouts,
               scene.background_image.pixels.empty() ? "the background, no picture,"
                                                     : "the background's picture");
  if (!summary.bounds.empty())
    fmt::print("bounds     {} to {} m\n", shown(summary.bounds.min), shown(summary.bounds.max));
  fmt::print(
      "camera     at {} looking at {}, vertical field of view {:.4g} degrees, {} x {} pixels\n",
      shown(scene.camera.position), shown(scene.camera.target), scene.camera.fov,
      scene.resolution.width, scene.resolution.height);
  for (std::size_t i = 0; i < scene.media.size(); ++i)
    print_medium(fmt::format("media.{}", i), scene.media[i], summary.media[i]);
  for (std::size_t i = 0; i < summary.lights.size(); ++i)
    print_light(fmt::format("lights.{}", i), scene, i, summary.lights[i]);
  const airlight::MemorySummary& memory = summary.memory;
  fmt::print("memory     about {}: geometry {}, textures {}, hierarchy {}, film {}\n",
             bytes(memory.total()), bytes(memory.geometry), bytes(memory.textures),
             bytes(memory.hierarchy), bytes(memory.film));
  for (const std::string& remark : scene.assumptions) fmt::print("remark     {}\n", remark);
  for (const std::string& remark : summary.remarks) fmt::print("remark     {}\n", remark);
  for (const std::string& warning : summary.warnings) fmt::print("warning    {}\n", warning);
}

}  // namespace

Action set_up_info(CLI::App& verb) {
  const auto flags = std::make_shared<SceneFlags>();
  verb.footer(examples);
  flags->declare(verb);
  return [flags] {
    const airlight::Scene scene = flags->load();
    print(scene, airlight::summarise(scene));
    return 0;
  };
}
