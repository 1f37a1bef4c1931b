#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace airlight {

/// A picture in memory: linear light, interleaved channels, row 0 on top.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;           ///< values a pixel has; 3 is R, G, B with Rec. 709 primaries
  std::vector<float> pixels;  ///< width * height * channels values

  Image() = default;

  /// A picture of zeros.
  Image(int width, int height, int channels = 3)
      : width(width),
        height(height),
        channels(channels),
        pixels(std::size_t(width) * std::size_t(height) * std::size_t(channels)) {}

  float& at(int x, int y, int c) { return pixels[index(x, y) + std::size_t(c)]; }
  float at(int x, int y, int c) const { return pixels[index(x, y) + std::size_t(c)]; }

  std::span<float> row(int y) { return {pixels.data() + index(0, y), row_size()}; }
  std::span<const float> row(int y) const { return {pixels.data() + index(0, y), row_size()}; }

  std::size_t row_size() const { return std::size_t(width) * std::size_t(channels); }

 private:
  std::size_t index(int x, int y) const {
    return (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels);
  }
};

}  // namespace airlight
