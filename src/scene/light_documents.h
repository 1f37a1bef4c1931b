#pragma once
#include <airlight/lights.h>

#include <optional>
#include <variant>

#include "scene/cursor.h"
#include "scene/required.h"

namespace airlight {

/// A directional light as a file says it: its direction of travel, or where in the sky it stands.
struct DirectionalDocument {
  Required<Rgb<double>> irradiance;
  std::optional<Vec3<double>> direction;
  std::optional<double> azimuth;
  std::optional<double> elevation;
  double angular_diameter = 0;

  static constexpr auto name = Directional::name;
  static constexpr auto meaning = Directional::meaning;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = DirectionalDocument;
    field("irradiance", &D::irradiance, unit::irradiance, at_least(0),
          "on a surface that faces the light, outside the medium");
    field("direction", &D::direction, unit::none, any_number(),
          "of travel, of any length; instead of azimuth and elevation");
    field("azimuth", &D::azimuth, unit::degree, closed(-360, 360),
          "where the light comes from, seen from above: 0 is north (-z), 90 east (+x)");
    field("elevation", &D::elevation, unit::degree, closed(-90, 90),
          "where the light comes from, above the horizon; 90 is straight down (up is +y)");
    field("angular_diameter", &D::angular_diameter, unit::degree, Range{0, 90, false, true},
          "of the light's disc; the sun's is 0.53; 0 is parallel light");
  }

  /// Throws Error unless the direction is given in exactly one way.
  Directional light(const Cursor& at) const;
};

/// Every kind of light as a file says it.
using LightDocuments = std::variant<DirectionalDocument>;

}  // namespace airlight
