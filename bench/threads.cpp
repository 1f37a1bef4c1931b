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

/// Runs a piece of work in `count` processes at once and waits for all. Throws Error if one fails.
template <class Work>
void in_processes(int count, Work&& work) {
  std::vector<pid_t> children;
  for (int i = 0; i < count; ++i) {
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
    children.push_back(child);
  }
  bool failed = false;
  for (pid_t child : children) {
    int status = 1;
    failed |= waitpid(child, &status, 0) != child || status != 0;
  }
  if (failed) throw Error("a render in a process of its own failed");
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
      5, [&] { in_processes(2, [&] { render_with(1); }); },
      [&] { in_processes(1, [&] { render_with(2), render_with(2); }); });
  return {{"threads.two_over_two_processes", ratio, "x", Must::at_least(0.95),
           kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
