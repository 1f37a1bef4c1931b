#pragma once
#include <array>
#include <cstdint>

namespace airlight {

/// Linear light in [0, 1] of each 8 bit sRGB code (IEC 61966-2-1).
extern const std::array<float, 256> linear_of_srgb;

/// Linear light of a code in [0, 1], as finer codes than 8 bits have it.
double linear_of_code(double code);

/// The 8 bit sRGB code nearest to a linear value; values outside [0, 1] are clipped.
/// `srgb_of_linear(linear_of_srgb[c]) == c` for every code.
std::uint8_t srgb_of_linear(float linear);

}  // namespace airlight
