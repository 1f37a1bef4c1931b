#include "quality.h"

#include <cmath>

#include "image/metrics.h"
#include "measure.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {

std::vector<Row> quality() {
  Scene scene = sunroom();
  scene.resolution = {640, 360};
  RenderSettings settings = scene.render;
  settings.estimator = "mcwvds", settings.threads = 2;
  const auto picture = [&](int spp, int seed) {
    settings.spp = spp, settings.seed = seed;
    return Renderer(scene).render(settings).film.layer("beauty");
  };
  const Image reference = picture(1024, 1);

  std::vector<double> decibels, seconds;
  for (int spp = 2; spp <= 128; spp *= 2) {
    decibels.push_back(-10 * std::log10(compare(picture(spp, 0), reference).rel_mse));
    seconds.push_back(median_seconds(5, [&] { picture(spp, 0); }));
  }
  const char* isa = kernel_for(InstructionSet::best).name;
  const auto row = [&](const char* name, double rel_mse) {
    return Row{name, seconds_to(-10 * std::log10(rel_mse), decibels, seconds), "s", {}, isa};
  };
  return {row("quality.sunroom_relmse_05", 0.05), row("quality.sunroom_relmse_01", 0.01),
          row("quality.sunroom_relmse_001", 0.001)};
}

}  // namespace airlight::bench
