#include <fmt/format.h>

#include "image/metrics.h"
#include "render/render.h"
#include "study/reproduction.h"
#include "study/reproductions/000/coloured_fog.h"

namespace airlight::paper_000 {

/// Beyond the paper, whose media are grey: whole-volume samples in RGB, Monte Carlo against ratio
/// form.
void rgb(Reproduced& out) {
  constexpr int seeds = 8;
  struct Bound {
    const char* channel;
    double sigma_t, at_4, at_16;  ///< the largest ratio that holds
  };
  constexpr Bound bounds[] = {
      {"red", 0.3, 1.02, 1.04}, {"green", 1, 0.8, 0.95}, {"blue", 3, 0.02, 0.06}};
  for (int spp : {4, 16}) {
    const Rgb<double> ratio = errors_in_coloured_fog(spp, seeds).ratio();
    for (int c = 0; c < 3; ++c)
      out.rows.push_back({fmt::format("{} ({} /m), {} spp: MSE of rewv / MSE of mcwvds",
                                      bounds[c].channel, bounds[c].sigma_t, spp),
                          {},
                          ratio[c],
                          0,
                          spp == 4 ? bounds[c].at_4 : bounds[c].at_16});
  }

  out.page.paragraph(
      "The paper's media are grey, and in these whole-volume samples have equal weights: Monte "
      "Carlo and ratio form are the same. Where channels are extinguished differently, one set of "
      "samples can't follow all of them. Samples are drawn from the mean of the channels' "
      "distributions, inverted as a whole so that strata stay strata, and weighted by the balance "
      "heuristic; the weights vary along the ray, and the Monte Carlo form `mcwvds` is noisy even "
      "where nothing is shadowed. The ratio form `rewv` "
      "divides by the sum of the same weights: it is exact wherever the light is the same along "
      "the ray, with the same samples.");
  out.page.checks(out.rows,
                  fmt::format("Squared error over {} seeds against the exact picture. The "
                              "paper has no numbers for this.",
                              seeds));

  const Scene scene = coloured_fog();
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.spp = 4;
  const auto rendered = [&](const char* estimator) {
    settings.estimator = estimator;
    return renderer.render(settings).film.layer("beauty");
  };
  const Image exact = rendered("closed_form"), monte_carlo = rendered("mcwvds"),
              ratio = rendered("rewv");
  out.page.figures(
      std::vector<Figure>{
          out.picture("exact", exact, "exact"),
          out.picture("mcwvds", monte_carlo, "mcwvds, 4 spp"),
          out.picture("rewv", ratio, "rewv, 4 spp"),
          out.picture("mcwvds_difference", difference_image(monte_carlo, exact, 4),
                      "mcwvds: 4 × |difference|"),
          out.picture("rewv_difference", difference_image(ratio, exact, 4),
                      "rewv: 4 × |difference|"),
      },
      3, "Configuration B of 000/fig6-single with σ_{t} = (0.3, 1, 3) /m.");
}

}  // namespace airlight::paper_000
