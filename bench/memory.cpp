#include "memory.h"

#include <unistd.h>

#include <filesystem>

#include "image/output.h"
#include "process.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// The most memory that a piece of work had in use at once, in a process of its own.  [bytes]
template <class Work>
double peak_bytes(Work&& work) {
  return 1024. * double(finish(start(work)).ru_maxrss);
}

}  // namespace

std::vector<Row> memory() {
  Scene scene = sunroom();
  scene.resolution = {1920, 1080};
  RenderSettings settings = scene.render;
  settings.spp = 1;
  const double pixels = double(scene.resolution.width) * scene.resolution.height;
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("airlight_bench_" + std::to_string(getpid()) + ".exr");
  const double scene_and_bvh = peak_bytes([&] { const World world(scene, settings.visibility); });
  const double whole = peak_bytes([&] {
    const Rendered rendered = Renderer(scene).render(settings);
    write_picture(path, rendered.film.picture());
  });
  std::filesystem::remove(path);
  const double allowed = 64. * 1024 * 1024;
  return {{"memory.bytes_a_pixel_beyond_64_MB", (whole - scene_and_bvh - allowed) / pixels, "bytes",
           Must::at_most(200), kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
