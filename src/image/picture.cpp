#include "image/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "error.h"

namespace airlight {

void fill_row(const Layer& layer, int y, std::span<float> row, const std::filesystem::path& path) {
  layer.fill(y, row);
  const auto fits = [&](float value) {
    if (layer.storage == Storage::id)
      return value >= 0 && value <= 0x1p24F && value == std::trunc(value);
    return std::isfinite(value);
  };
  const auto bad = std::ranges::find_if_not(row, fits);
  if (bad == row.end()) return;
  const std::size_t i = std::size_t(bad - row.begin());
  const std::size_t channels = layer.channels.size();
  throw Error(fmt::format(
      "{}: layer {}.{} is {} at pixel {},{}; accepted: {}", path.string(), layer.name,
      layer.channels[i % channels], *bad, i / channels, y,
      layer.storage == Storage::id ? "whole numbers from 0 to 16777216" : "finite numbers"));
}

void add_alpha(Picture& picture) {
  const auto found = std::ranges::find(picture.layers, "transmittance", &Layer::name);
  if (found == picture.layers.end())
    throw Error("a picture without the layer transmittance can have no alpha");
  const auto shadow = std::ranges::find(picture.layers, "shadow", &Layer::name);
  const auto darken = shadow == picture.layers.end() ? nullptr : shadow->fill;
  picture.alpha = {"alpha", {"A"}, [fill = found->fill, darken](int y, std::span<float> row) {
                     std::vector<float> passes(3 * row.size());
                     fill(y, passes);
                     if (darken) {
                       std::vector<float> left(passes.size());
                       darken(y, left);
                       std::ranges::transform(passes, left, passes.begin(), std::multiplies());
                     }
                     for (std::size_t x = 0; x < row.size(); ++x) {
                       const float* p = &passes[3 * x];
                       row[x] = 1 - (p[0] + p[1] + p[2]) / 3;
                     }
                   }};
}

Picture picture_of(const Image& image) {
  Picture picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.layers = {{"beauty", {"R", "G", "B"}, [&image](int y, std::span<float> row) {
                       std::ranges::copy(image.row(y), row.begin());
                     }}};
  return picture;
}

}  // namespace airlight
