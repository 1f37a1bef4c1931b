#pragma once
#include <airlight/math/vec.h>

#include <optional>

namespace airlight {

/// The vector brought to unit length, whatever its own; none for the zero vector.
inline std::optional<Vec3<double>> unit_vector(Vec3<double> v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return std::nullopt;
  // By two divisions: the reciprocal of a denormal number is infinite.
  const Vec3<double> scaled{v.x / largest, v.y / largest, v.z / largest};
  return normalize(scaled);
}

/// Unit vector towards a place in the sky, in degrees: azimuth clockwise seen from above, from
/// north (-z) over east (+x); elevation above the horizon; up is +y.
inline Vec3<double> toward_sky(double azimuth, double elevation) {
  const double a = azimuth * (pi / 180), e = elevation * (pi / 180);
  return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

}  // namespace airlight
