#include "checkpoints.h"

#include <unistd.h>

#include <filesystem>

#include "image/output.h"
#include "measure.h"
#include "render/checkpoint.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {

std::vector<Row> checkpoints() {
  Scene scene = sunroom();
  scene.resolution = {640, 360};
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.first_sample = 0;
  const auto file = [](const char* name) {
    return std::filesystem::temp_directory_path() /
           ("airlight_bench_" + std::to_string(getpid()) + name);
  };
  const auto render_into = [&](const std::filesystem::path& path, double every) {
    std::filesystem::remove(path);
    RenderControl control;
    control.checkpoint = {.file = path, .every = every, .on_failure = {}};
    renderer.render(settings, control);
  };

  // Long enough for some checkpoints. One in two seconds of a picture of this size is, for the
  // disk, one in 18 s of 1920 x 1080; the default is a minute.
  constexpr double every = 2, long_enough = 5;
  for (settings.spp = 64; seconds([&] { renderer.render(settings); }) < long_enough;)
    settings.spp *= 2;
  const std::filesystem::path a = file("a.ckpt"), b = file("b.ckpt"), sum = file("sum.exr");
  const double kept = median_ratio(
      5, [&] { render_into(a, every); }, [&] { renderer.render(settings); });

  settings.first_sample = settings.spp;
  const double rendering = seconds([&] { render_into(b, 1e6); });
  const double merging = median_seconds(3, [&] {
    Checkpoint both = read_checkpoint(a);
    merge(both, read_checkpoint(b));
    write_picture(sum, both.film.picture());
  });
  for (const auto& path : {a, b, sum}) std::filesystem::remove(path);
  const char* const isa = kernel_for(InstructionSet::best).name;
  return {{"checkpoints.part_of_a_render", 100 * (kept - 1), "%", Must::at_most(2), isa},
          {"checkpoints.merging_two_renders", 100 * merging / (2 * rendering), "%",
           Must::at_most(2), isa}};
}

}  // namespace airlight::bench
