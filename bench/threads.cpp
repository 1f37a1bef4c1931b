#include "threads.h"

#include <sys/wait.h>
#include <unistd.h>

#include "error.h"
#include "measure.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// Runs a piece of work in two processes at once and waits for both.
template <class Work>
void in_two_processes(Work&& work) {
  pid_t children[2];
  for (pid_t& child : children) {
    child = fork();
    if (child < 0) throw Error("a process cannot be started");
    if (child == 0) {
      work();
      _exit(0);
    }
  }
  for (pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    if (status != 0) throw Error("a render in a process of its own failed");
  }
}

}  // namespace

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
      5, [&] { in_two_processes([&] { render_with(1); }); },
      [&] {
        const pid_t child = fork();
        if (child == 0) {
          render_with(2), render_with(2);
          _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
      });
  return {{"threads.two_over_two_processes", ratio, "x", Must::at_least(0.95),
           kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
