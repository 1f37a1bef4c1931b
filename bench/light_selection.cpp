#include "light_selection.h"

#include "image/metrics.h"
#include "render/kernel.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {

std::vector<Row> light_selection() {
  Scene scene = sphere_in_fog();
  scene.lights.clear();
  const Vec3<double> travel[] = {
      {-1, -1, 0.2}, {0.8, -0.6, -0.5}, {0.2, -1, 1}, {1, 0.3, 0.1}, {-0.3, 0.8, -1}};
  double irradiance = 10;
  for (const Vec3<double>& direction : travel) {
    scene.lights.push_back(
        Directional{.irradiance = Rgb<double>(irradiance), .direction = normalize(direction)});
    irradiance /= 2;
  }
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.samples_per_ray = 0;
  settings.spp = 1;
  settings.estimator = "closed_form";
  const Image exact = renderer.render(settings).film.layer("beauty");
  settings.estimator = "mcwvds";
  const auto error = [&](LightSelection selection) {
    settings.light_selection = selection;
    double sum = 0;
    for (int seed = 0; seed < 4; ++seed) {
      settings.seed = seed;
      sum += compare(renderer.render(settings).film.layer("beauty"), exact).mse;
    }
    return sum;
  };
  // Of the relative variances .35 and 1.57 of random sets of lights and shadows: 4.5.
  return {{"light_selection.uniform_over_unoccluded",
           error(LightSelection::uniform) / error(LightSelection::unoccluded), "x",
           Must::at_least(3), kernel_for(InstructionSet::best).name}};
}

}  // namespace airlight::bench
