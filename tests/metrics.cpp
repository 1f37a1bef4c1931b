#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error.h"
#include "study/comparison.h"

using namespace airlight;

namespace {

Image pixels(std::vector<float> values) {
  Image image(int(values.size() / 3), 1);
  image.pixels = std::move(values);
  return image;
}

// Two pixels; the differences are 0.5, 0, -0.25, 0, 0, 1.
const Image image = pixels({1.5F, 2, 0.25F, 0, 1, 1});
const Image reference = pixels({1, 2, 0.5F, 0, 1, 0});

}  // namespace

TEST(Metrics, are_what_their_formulas_say) {
  const Metrics m = compare(image, reference);
  const double mse = (0.25 + 0.0625 + 1) / 6;
  EXPECT_DOUBLE_EQ(m.mse, mse);
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(mse));
  EXPECT_DOUBLE_EQ(m.psnr, -10 * std::log10(mse));
  EXPECT_DOUBLE_EQ(m.mae, 1.75 / 6);
  EXPECT_DOUBLE_EQ(m.rel_mse, (0.25 / 1.01 + 0.0625 / 0.26 + 1 / 0.01) / 6);
}

TEST(Metrics, psnr_of_a_known_error_is_a_round_number) {
  const Image off_by_a_tenth = pixels({0.1F, -0.1F, 0.1F});
  EXPECT_NEAR(compare(off_by_a_tenth, Image(1, 1)).psnr, 20, 1e-6);  // 0.1 in float is off by 1e-8
}

TEST(Metrics, find_no_error_between_equals) {
  const Metrics m = compare(image, image);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.rel_mse, 0);
  EXPECT_EQ(m.mae, 0);
  EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
}

TEST(Metrics, lose_nothing_over_many_pixels) {
  Image many(1000, 1000);
  for (float& value : many.pixels) value = 0.1F;
  EXPECT_NEAR(compare(many, Image(1000, 1000)).rmse, double(0.1F), 1e-10);  // 3e6 sums in double
}

TEST(Metrics, refuse_images_of_other_sizes) {
  EXPECT_THROW(compare(image, Image(1, 2)), Error);
  EXPECT_THROW(difference_image(image, Image(2, 2)), Error);
}

TEST(Metrics, refuse_values_that_are_not_finite) {
  Image broken = image;
  broken.at(1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(compare(broken, reference), Error);
}

TEST(Metrics, stand_in_the_list_once_each) {
  Metrics m;
  for (const Metric& metric : metric_list) m.*metric.value += 1;
  for (const double times : {m.mse, m.rmse, m.rel_mse, m.psnr, m.mae}) EXPECT_EQ(times, 1);
}

TEST(DifferenceImage, is_absolute_and_scaled) {
  EXPECT_EQ(difference_image(image, reference, 2).pixels,
            (std::vector<float>{1, 0, 0.5F, 0, 0, 2}));
}

TEST(Difference, of_two_estimators_is_that_of_each_seed) {
  const auto measured = [](std::vector<double> psnr) {
    Measured row{};
    for (const double value : psnr) row.of_seeds.push_back({.psnr = value});
    return row;
  };
  const Spread lead = difference(measured({30, 20, 10}), measured({29, 18, 7}), &Metrics::psnr);
  EXPECT_EQ(lead.count, 3u);
  EXPECT_DOUBLE_EQ(lead.mean, 2);
  EXPECT_DOUBLE_EQ(lead.standard_deviation, 1);
  EXPECT_THROW(difference(measured({30, 20}), measured({29}), &Metrics::psnr), Error);
}
