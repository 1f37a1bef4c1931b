#include "image/srgb.h"

#include <algorithm>
#include <cmath>

namespace airlight {

const std::array<float, 256> linear_of_srgb = [] {
  std::array<float, 256> table{};
  for (int code = 0; code < 256; ++code) {
    const double c = code / 255.0;
    table[std::size_t(code)] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}();

std::uint8_t srgb_of_linear(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  const float c = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
  return std::uint8_t(c * 255 + 0.5F);
}

}  // namespace airlight
