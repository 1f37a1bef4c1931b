#include "study/reproductions/000/coloured_fog.h"

#include "render/render.h"
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {
namespace {

Rgb<double> channel_mse(const Image& image, const Image& reference) {
  Rgb<double> sum(0.);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double off = double(image.pixels[i]) - double(reference.pixels[i]);
    sum[int(i % 3)] += off * off;
  }
  return sum * (1. / (double(image.width) * image.height));
}

}  // namespace

Scene coloured_fog() {
  Scene scene = black_ball(configurations[1]);
  scene.media[0].sigma_t = {0.3, 1, 3};
  scene.media[0].sigma_s = Rgb<double>(0.3);
  return scene;
}

ChannelErrors errors_in_coloured_fog(int spp, int seeds) {
  const Scene scene = coloured_fog();
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.estimator = "closed_form";
  settings.spp = 1;
  const Image exact = renderer.render(settings).film.layer("beauty");
  settings.spp = spp;
  const auto mean_error = [&](const char* estimator) {
    settings.estimator = estimator;
    Rgb<double> sum(0.);
    for (settings.seed = 0; settings.seed < seeds; ++settings.seed)
      sum += channel_mse(renderer.render(settings).film.layer("beauty"), exact);
    return sum * (1. / seeds);
  };
  ChannelErrors errors;
  errors.rewv = mean_error("rewv");
  errors.mcwvds = mean_error("mcwvds");
  return errors;
}

}  // namespace airlight::paper_000
