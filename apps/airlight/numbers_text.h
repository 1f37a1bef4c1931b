#pragma once
#include <airlight/math/vec.h>
#include <fmt/format.h>

#include <string>

/// "(1, 2, 3)", each number with so many digits.
inline std::string text(const airlight::Vec3<double>& v, int digits) {
  // No −0.
  return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", v.x + 0., digits, v.y + 0., digits, v.z + 0.,
                     digits);
}

/// "[1, 2, 3]", or one number where the channels are equal.
inline std::string text(const airlight::Rgb<double>& c, int digits) {
  if (c.r == c.g && c.g == c.b) return fmt::format("{:.{}g}", c.r, digits);
  return fmt::format("[{:.{}g}, {:.{}g}, {:.{}g}]", c.r, digits, c.g, digits, c.b, digits);
}
