// Whole-volume samples where red, green and blue are extinguished differently: what the ratio form
// (`rewv`, the default) makes of them against Monte Carlo (`mcwvds`).

#include <gtest/gtest.h>

#include "image/metrics.h"
#include "render/render.h"
#include "study/reproductions/000/coloured_fog.h"

namespace airlight::paper_000 {
namespace {

TEST(RgbFog, has_less_noise_in_ratio_form) {
  // The bright channels keep the noise of shadows, which no form removes; in the dark one Monte
  // Carlo has weights that vary by far more. A prototype had 0.97, 0.71 and 0.003; the bounds leave
  // room for other scrambles.
  const Rgb<double> ratio = errors_in_coloured_fog(4, 4).ratio();
  EXPECT_LE(ratio.r, 1.02);
  EXPECT_LE(ratio.g, 0.8);
  EXPECT_LE(ratio.b, 0.02);
  for (int c = 0; c < 3; ++c) EXPECT_GT(ratio[c], 0);
}

TEST(RgbFog, of_a_slight_tint_costs_no_more_than_grey_fog) {
  // Strata are kept through the inversion for all channels; drawing a channel for every sample
  // first would leave more than twice the error here.
  const auto mse = [](const Rgb<double>& sigma_t) {
    Scene scene = coloured_fog();
    scene.media[0].sigma_t = sigma_t;
    Renderer renderer(scene);
    RenderSettings settings = scene.render;
    settings.spp = 1;
    settings.estimator = "closed_form";
    const Image exact = renderer.render(settings).film.layer("beauty");
    settings.spp = 16;
    settings.estimator = "mcwvds";
    double sum = 0;
    for (settings.seed = 0; settings.seed < 4; ++settings.seed)
      sum += compare(renderer.render(settings).film.layer("beauty"), exact).mse;
    return sum;
  };
  EXPECT_LT(mse({0.95, 1, 1.05}), 1.1 * mse(Rgb<double>(1)));
}

}  // namespace
}  // namespace airlight::paper_000
