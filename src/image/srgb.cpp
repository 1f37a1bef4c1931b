#include "image/srgb.h"

#include <algorithm>
#include <cmath>

namespace airlight {

const std::array<float, 256> linear_of_srgb = [] {
  std::array<float, 256> table{};
  for (int code = 0; code < 256; ++code)
    table[std::size_t(code)] = float(linear_of_code(code / 255.0));
  return table;
}();

double linear_of_code(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

std::uint8_t srgb_of_linear(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  const float c = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
  return std::uint8_t(c * 255 + 0.5F);
}

}  // namespace airlight
