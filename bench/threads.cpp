#include "threads.h"

#include "measure.h"
#include "process.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {

std::vector<Row> threads() {
  const Scene scene = sunroom();
  RenderSettings settings = scene.render;
  settings.spp = 64;
  const auto render_with = [&](int threads) {
    settings.threads = threads;
    Renderer(scene).render(settings);
  };
  // Both start from nothing in a process of its own; two threads have one picture to render, two
  // processes two.
  const double ratio = median_ratio(
      5,
      [&] {
        const pid_t one = start([&] { render_with(1); }), other = start([&] { render_with(1); });
        finish(one), finish(other);
      },
      [&] { finish(start([&] { render_with(2), render_with(2); })); });
  return {{"threads.two_over_two_processes", ratio, "x", Must::at_least(0.95),
           kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
