#include "scene/light_documents.h"

#include "scene/direction.h"

namespace airlight {

Directional DirectionalDocument::light(const Cursor& at) const {
  Directional light;
  light.irradiance = *irradiance;
  light.angular_diameter = angular_diameter;
  constexpr auto accepted = "accepted: direction, or azimuth and elevation";
  if (direction && (azimuth || elevation))
    at.complain(std::string("gives its direction twice; ") + accepted);
  if (direction) {
    const auto unit = unit_vector(*direction);
    if (!unit)
      at.at_or_here("direction").refuse("is no direction: at least one number must not be 0");
    light.direction = *unit;
  } else if (azimuth && elevation) {
    light.direction = -toward_sky(*azimuth, *elevation);
  } else {
    at.complain(std::string("does not say where its light goes; ") + accepted);
  }
  return light;
}

}  // namespace airlight
