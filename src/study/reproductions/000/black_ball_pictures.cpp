#include "study/reproductions/000/black_ball_pictures.h"

#include <fmt/format.h>

namespace airlight::paper_000 {

void show_pictures(Reproduced& out, const Configuration& configuration,
                   const Comparison& comparison, const std::string& reference) {
  const auto picture = [&](const std::string& name, const Image& image,
                           const std::string& caption) {
    return out.picture(fmt::format("{}_{}", configuration.name, name), image, caption);
  };
  std::vector<Figure> pictures;
  for (const Measured& m : comparison.rows)
    pictures.push_back(
        picture(m.estimator, m.picture,
                fmt::format("{}, {:.2f} dB", upper_case(m.estimator), m.of(&Metrics::psnr).mean)));
  for (const Measured& m : comparison.rows)
    pictures.push_back(picture(m.estimator + "_difference",
                               difference_image(m.picture, comparison.reference, 4),
                               "4 × |difference|"));
  pictures.push_back(picture(reference, comparison.reference, reference));
  out.page.figures(
      pictures, 5,
      fmt::format("The first seed of each estimator, and its distance from the {} picture.",
                  reference));
}

}  // namespace airlight::paper_000
