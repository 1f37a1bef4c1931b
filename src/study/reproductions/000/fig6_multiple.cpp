#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/comparison.h"
#include "study/reproduction.h"
#include "study/reproductions/000/black_ball.h"

namespace airlight::paper_000 {
namespace {

constexpr int seeds = 16;

/// PSNR of an estimator at 4 spp: as published, and as measured once and for all with this scene.
struct Expected {
  const char* estimator;
  double published, before;
};
constexpr double tolerance = 0.4;
constexpr Expected expected[] = {{"mcwvds", 25.90, 25.90},
                                 {"reds", 25.89, 25.88},
                                 {"mcds", 25.43, 25.26},
                                 {"rees", 25.31, 24.64},
                                 {"rm", 24.95, 22.86}};
constexpr std::size_t held = 3;  ///< the first of these, which are held to what was measured
/// The published values of the first two are 0.01 dB apart; ours are level.
constexpr double level = 0.2;

/// The value that a part of all values lies below, linear between its neighbours.
double quantile(std::vector<float> values, double part) {
  std::ranges::sort(values);
  const double at = part * double(values.size() - 1);
  const auto below = std::size_t(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(double(values[below]), double(values[above]), at - double(below));
}

}  // namespace

/// Figure 6 (f) to (j): five estimators at 4 spp, multiple scattering.
void fig6_multiple(Reproduced& out) {
  std::vector<std::string> estimators;
  for (const Expected& e : expected) estimators.push_back(e.estimator);
  const Comparison comparison = compare_estimators(
      black_ball_many_times(),
      {.estimators = estimators, .spp = {4}, .seeds = seeds, .reference_spp = 32768});
  const auto psnr = [&](std::size_t i) { return comparison.rows[i].of(&Metrics::psnr).mean; };
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    const Expected& e = expected[i];
    out.rows.push_back({upper_case(e.estimator) + ": PSNR [dB]", e.published, psnr(i),
                        i < held ? e.before - tolerance : -INFINITY,
                        i < held ? e.before + tolerance : INFINITY});
  }
  for (std::size_t i = 0; i + 1 < std::size(expected); ++i)
    out.rows.push_back(
        {fmt::format("PSNR of {} − PSNR of {} [dB]", upper_case(expected[i].estimator),
                     upper_case(expected[i + 1].estimator)),
         expected[i].published - expected[i + 1].published, psnr(i) - psnr(i + 1),
         i == 0 ? -level : 0, INFINITY});
  out.rows.push_back({"99.9 % quantile of the reference [W/(m² sr)]",
                      {},
                      quantile(comparison.reference.pixels, 0.999),
                      0.98,
                      1.02});

  out.page.paragraph(
      "As in 000/fig6-single, the paper prints a PSNR for each of five estimators and not its "
      "scene. This is configuration A of that page with an albedo of 0.86, isotropic scattering up "
      "to twelve times, 48 × 48 pixels, as bright as makes the 99.9 % quantile of the picture 1; "
      "albedo and brightness were fitted to the first number. A path asks the light once on each "
      "segment and goes on from the same sample (`continuation = \"sample\"`); the default, which "
      "draws a free flight, ends paths that leave the fog and stands at about 22 dB here.");
  out.page.paragraph(
      "The paper's first three numbers are reached, and its order but for the first two, which are "
      "level here: over 4096 seeds MCWVDS stands at 26.222 dB and REDS at 26.226 dB, each known to "
      "0.003 dB; the paper prints 0.01 dB between them, the other way round. Its spread of RM and "
      "REES is not reached: with this scene they lie farther behind than published. Going on from "
      "equidistant samples gives paths weights that vary, of which the paper says nothing.");
  out.page.checks(
      out.rows,
      fmt::format(
          "Mean PSNR over {} seeds at 4 spp, peak 1. The ranges are ±{} dB about what an earlier "
          "implementation, not part of this project, measured on the same scene. Reference: {}.",
          seeds, tolerance, comparison.reference_source));
  std::vector<Figure> pictures;
  for (const Measured& m : comparison.rows)
    pictures.push_back(out.picture(
        m.estimator, m.picture,
        fmt::format("{}, {:.2f} dB", upper_case(m.estimator), m.of(&Metrics::psnr).mean)));
  for (const Measured& m : comparison.rows)
    pictures.push_back(out.picture(m.estimator + "_difference",
                                   difference_image(m.picture, comparison.reference, 4),
                                   "4 × |difference|"));
  pictures.push_back(out.picture("reference", comparison.reference, "reference"));
  out.page.figures(pictures, 5,
                   "The first seed of each estimator, and its distance from the reference.");
}

}  // namespace airlight::paper_000
