#include <fmt/format.h>

#include "study/comparison.h"
#include "study/reproduction.h"
#include "study/reproductions/000/black_ball.h"
#include "study/reproductions/000/black_ball_pictures.h"

namespace airlight::paper_000 {
namespace {

constexpr int seeds = 8;

/// PSNR of an estimator at 4 spp: as published, and as measured once and for all with our two
/// configurations, within a quarter of a decibel.
struct Expected {
  const char* estimator;
  double published, a, b;
};
constexpr double tolerance = 0.25;
constexpr Expected expected[] = {
    {"mcwvds", 35.49, 35.28, 34.96}, {"rm", 28.12, 28.14, 28.37},   {"rees", 32.77, 32.79, 33.06},
    {"mcds", 31.76, 31.82, 31.43},   {"reds", 35.01, 35.06, 34.70},
};

}  // namespace

/// Figure 6 (a) to (e): five estimators at 4 spp, single scattering.
void fig6_single(Reproduced& out) {
  std::vector<Comparison> comparisons;
  for (const Configuration& configuration : configurations) {
    const bool is_a = &configuration == configurations;
    const Comparison& comparison = comparisons.emplace_back(compare_estimators(
        black_ball(configuration), {.estimators = {five_estimators.begin(), five_estimators.end()},
                                    .spp = {4},
                                    .seeds = seeds}));
    for (std::size_t i = 0; i < five_estimators.size(); ++i) {
      const Expected& e = expected[i];
      const double value = is_a ? e.a : e.b;
      out.rows.push_back(
          {fmt::format("{}, {}: PSNR [dB]", configuration.name, upper_case(e.estimator)),
           e.published, comparison.rows[i].of(&Metrics::psnr).mean, value - tolerance,
           value + tolerance});
    }
  }

  out.page.paragraph(
      "The paper prints a PSNR for each of five estimators and neither the extinction nor the "
      "camera, the ball, the light or the scale of its scene. The scene was fitted to the "
      "published numbers: some 300 000 configurations were searched for those whose five values "
      "come closest. So the agreement shows that the published pattern can be had, with one scene "
      "for all five estimators and with jittered strata in each of them; it does not show that "
      "this is the authors' scene. Configuration A comes closest to the numbers. B was also asked "
      "to behave over all sample counts as the paper's text says (see 000/fig7-single).");
  out.page.checks(
      out.rows,
      fmt::format("Mean PSNR over {} seeds at 4 spp against the exact picture, peak 1. The ranges "
                  "are ±{} dB about what an earlier implementation, not part of this project, "
                  "measured on the same scenes.",
                  seeds, tolerance));
  for (std::size_t c = 0; c < comparisons.size(); ++c) {
    const Configuration& at = configurations[c];
    out.page.heading(fmt::format("Configuration {}", at.name));
    out.page.paragraph(fmt::format(
        "σ_{{t}} = {} /m, a black ball of radius {} m in the middle of a cube of fog 2 m wide, "
        "light from ({}, {}, {}), the eye at ({}, {}, {}) m, vertical field of view {}°, radiance "
        "{} /m × ∫ V e^{{−τ}} dt.",
        at.sigma_t, ball_radius, at.toward.x, at.toward.y, at.toward.z, at.eye.x, at.eye.y,
        at.eye.z, at.fov, at.strength));
    show_pictures(out, at, comparisons[c], "exact");
  }
}

}  // namespace airlight::paper_000
