// Whole-volume samples where red, green and blue are extinguished differently: what the ratio form
// (`rewv`, the default) makes of them against Monte Carlo (`mcwvds`).

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace airlight::paper_000
