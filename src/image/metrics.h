#pragma once
#include <array>

#include "image/image.h"

namespace airlight {

/// How far an image is from its reference. a: a value of the image, b: of the reference; means run
/// over all pixels and channels, in linear light.
struct Metrics {
  double mse = 0;
  double rmse = 0;
  double rel_mse = 0;
  double psnr = 0;
  double mae = 0;
};

/// One metric, as reports print it.
struct Metric {
  const char* name;
  const char* formula;
  const char* unit;
  double Metrics::*value;
  bool higher_is_better;
};

inline constexpr std::array<Metric, 5> metric_list{{
    {"RMSE", "sqrt(mean((a − b)²))", "W/(m² sr)", &Metrics::rmse, false},
    {"relMSE", "mean((a − b)² / (b² + 0.01))", "1", &Metrics::rel_mse, false},
    {"PSNR", "−10 log10(mean((a − b)²)), peak 1", "dB", &Metrics::psnr, true},
    {"MAE", "mean(|a − b|)", "W/(m² sr)", &Metrics::mae, false},
    {"MSE", "mean((a − b)²)", "(W/(m² sr))²", &Metrics::mse, false},
}};

/// Where a metric stands in the list.
constexpr std::size_t index_of(double Metrics::*value) {
  std::size_t i = 0;
  while (metric_list[i].value != value) ++i;
  return i;
}

/// Sums run in double; PSNR of equal images is +infinity. Throws Error if the sizes differ or a
/// value is not finite.
Metrics compare(const Image& image, const Image& reference);

/// gain * |image - reference|, to be looked at. Throws Error if the sizes differ.
Image difference_image(const Image& image, const Image& reference, float gain = 1);

}  // namespace airlight
