#include "image/metrics.h"

#include <fmt/format.h>

#include <cmath>

#include "error.h"

namespace airlight {
namespace {

void check_same_size(const Image& image, const Image& reference) {
  const auto size = [](const Image& i) {
    return fmt::format("{} x {} with {} channels", i.width, i.height, i.channels);
  };
  if (size(image) != size(reference))
    throw Error(fmt::format("the image is {}, its reference {}; both must be the same", size(image),
                            size(reference)));
}

}  // namespace

Metrics compare(const Image& image, const Image& reference) {
  check_same_size(image, reference);
  double squares = 0;
  double relative_squares = 0;
  double absolutes = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double b = reference.pixels[i];
    const double difference = image.pixels[i] - b;
    squares += difference * difference;
    relative_squares += difference * difference / (b * b + 0.01);
    absolutes += std::abs(difference);
  }
  if (!std::isfinite(absolutes))
    throw Error("the image or its reference has values that are not finite");

  const auto count = double(image.pixels.size());
  Metrics metrics;
  metrics.mse = squares / count;
  metrics.rmse = std::sqrt(metrics.mse);
  metrics.rel_mse = relative_squares / count;
  metrics.psnr = -10 * std::log10(metrics.mse);
  metrics.mae = absolutes / count;
  return metrics;
}

Image difference_image(const Image& image, const Image& reference, float gain) {
  check_same_size(image, reference);
  Image difference(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    difference.pixels[i] = gain * std::abs(image.pixels[i] - reference.pixels[i]);
  return difference;
}

}  // namespace airlight
