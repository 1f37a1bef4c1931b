#include "memory.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "error.h"
#include "image/output.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// The most memory that a piece of work had in use at once, in a process of its own.  [bytes]
template <class Work>
double peak_bytes(Work&& work) {
  const pid_t child = fork();
  if (child < 0) throw Error("a process cannot be started");
  if (child == 0) {
    try {
      work();
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) throw Error("a render in a process of its own failed");
  return 1024. * double(usage.ru_maxrss);
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
