#include "study/reproductions/000/march_against_whole_volume.h"

#include <fmt/format.h>

#include "study/comparison.h"
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {

MarchAndWholeVolume march_against_whole_volume(Reproduced& out, const View& view, std::int64_t spp,
                                               int seeds, std::int64_t reference_spp) {
  const Comparison comparison = compare_estimators(view.scene, {.estimators = {"rm", "mcwvds"},
                                                                .spp = {spp},
                                                                .seeds = seeds,
                                                                .reference_spp = reference_spp});
  std::vector<Figure> pictures, errors;
  for (const Measured& m : comparison.rows) {
    const std::string stem = view.stem + "_" + m.estimator;
    pictures.push_back(
        out.picture(stem, m.picture,
                    fmt::format("{}, {:.2f} dB, RMSE {:.4f} W/(m² sr)", upper_case(m.estimator),
                                m.of(&Metrics::psnr).mean, m.of(&Metrics::rmse).mean)));
    errors.push_back(out.picture(stem + "_difference",
                                 difference_image(m.picture, comparison.reference, 4),
                                 "4 × |difference|"));
  }
  pictures.insert(pictures.end(), errors.begin(), errors.end());
  out.page.heading(view.name);
  out.page.paragraph(view.about);
  out.page.figures(
      pictures, 2,
      fmt::format("{} spp, means over {} seeds and the picture of the first, and its distance from "
                  "the reference: {}.",
                  spp, seeds, comparison.reference_source));
  const Measured &march = comparison.rows.at(0), &whole_volume = comparison.rows.at(1);
  return {march.of(&Metrics::psnr).mean, whole_volume.of(&Metrics::psnr).mean,
          march.of(&Metrics::rmse).mean, whole_volume.of(&Metrics::rmse).mean};
}

}  // namespace airlight::paper_000
