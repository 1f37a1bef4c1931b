#include "convergence.h"

#include <cmath>

#include "image/metrics.h"
#include "measure.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// An estimator's way to the wanted quality: seconds at each count and the PSNR reached there.
struct Run {
  RenderSettings settings;
  std::vector<double> psnr;
  std::vector<double> seconds;
};

constexpr int counts[] = {4, 8, 16, 32};

}  // namespace

std::vector<Row> convergence() {
  const Scene scene = sphere_in_fog();
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.threads = 1;
  settings.samples_per_ray = 0;
  settings.estimator = "closed_form";
  settings.spp = 1;
  const Image exact = renderer.render(settings).film.layer("beauty");

  Run whole_volume{settings, {}, {}}, cached{settings, {}, {}}, per_step{settings, {}, {}};
  whole_volume.settings.estimator = "mcwvds";
  cached.settings.estimator = per_step.settings.estimator = "rm";
  per_step.settings.edges = Edges::per_step;
  Run* const runs[] = {&whole_volume, &cached, &per_step};

  // PSNR is a property of the samples: measured once, over four seeds.
  for (Run* run : runs)
    for (int spp : counts) {
      double mse = 0;
      for (int seed = 0; seed < 4; ++seed) {
        run->settings.spp = spp, run->settings.seed = seed;
        mse += compare(renderer.render(run->settings).film.layer("beauty"), exact).mse / 4;
      }
      run->psnr.push_back(-10 * std::log10(mse));
    }

  const auto seconds_to_40_db = [](const Run& run) {
    return seconds_to(40, run.psnr, run.seconds);
  };
  std::vector<double> against_cached, against_per_step;
  for (int round = 0; round < 9; ++round) {
    for (Run* run : runs) run->seconds.clear();
    for (int spp : counts)
      for (Run* run : runs) {
        run->settings.spp = spp;
        run->seconds.push_back(median_seconds(3, [&] { renderer.render(run->settings); }));
      }
    const double time = seconds_to_40_db(whole_volume);
    against_cached.push_back(time / seconds_to_40_db(cached));
    against_per_step.push_back(time / seconds_to_40_db(per_step));
  }
  const char* isa = kernel_for(InstructionSet::best).name;
  return {
      {"convergence.mcwvds_over_rm_cached", median(against_cached), "x", Must::at_most(0.85), isa},
      {"convergence.mcwvds_over_rm_per_step", median(against_per_step), "x", Must::at_most(0.75),
       isa}};
}

}  // namespace airlight::bench
