#include "probe.h"

#include <fmt/format.h>

#include "error.h"
#include "extension.h"
#include "image/atomic_file.h"
#include "numbers.h"
#include "scene_flags.h"
#include "verbs.h"

namespace {

using airlight::Error;

struct Flags {
  SceneFlags scene;
  std::string pixel;
  std::filesystem::path plot;
  std::optional<std::size_t> ray;
  bool json = false;
  bool quiet = false;
};

constexpr const char* examples = R"(Examples:
  airlight probe scenes/sphere_in_fog.toml --pixel 128,60
  airlight probe scenes/sphere_in_fog.toml --pixel 128,60 -o ray.svg --estimator rees --spp 64
  airlight probe scenes/sphere_in_fog.toml --pixel 128,60 --json > ray.json
)";

int probe(const Flags& flags) {
  const auto pixel = whole_numbers(flags.pixel, ',');
  const auto fits = [](std::int64_t x) { return x >= 0 && x <= 65535; };
  if (pixel.size() != 2 || !fits(pixel[0]) || !fits(pixel[1]))
    throw Error("--pixel " + flags.pixel +
                ": is no pixel; accepted: X,Y from the upper left corner, such as 128,60");
  const bool plot = !flags.plot.empty();
  if (plot && airlight::extension_of(flags.plot) != ".svg")
    throw Error(fmt::format("{}: unknown plot format \"{}\"; accepted: .svg", flags.plot.string(),
                            flags.plot.extension().string()));
  if (plot) airlight::check_writable(flags.plot);
  const airlight::Scene scene = flags.scene.load();
  const airlight::Probe found = airlight::probe(scene, scene.render, int(pixel[0]), int(pixel[1]));
  if (flags.ray && *flags.ray >= found.rays.size())
    throw Error(fmt::format("--ray {}: is not there; accepted: 0 to {}, the rays of this pixel",
                            *flags.ray, found.rays.size() - 1));
  if (plot) airlight::write_text(flags.plot, probe_plot(found, flags.ray.value_or(0)));
  if (!flags.quiet)
    fmt::print("{}", flags.json ? probe_json(found, scene) : probe_text(found, scene, flags.ray));
  return 0;
}

}  // namespace

Action set_up_probe(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer(examples);
  flags->scene.declare(verb);
  verb.add_option("--pixel", flags->pixel, "X,Y from the upper left corner")
      ->required()
      ->type_name("")
      ->take_last();
  verb.add_option("-o,--output", flags->plot, "plots density, transmittance and lit parts (.svg)")
      ->type_name("FILE")
      ->take_last();
  verb.add_option("--ray", flags->ray, "the camera ray of the pixel to print and plot, from 0")
      ->type_name("")
      ->take_last();
  verb.add_flag("--json", flags->json, "prints everything as JSON, with 512 steps along each ray");
  verb.add_flag("--quiet", flags->quiet, "prints nothing but errors");
  return [flags] { return probe(*flags); };
}
