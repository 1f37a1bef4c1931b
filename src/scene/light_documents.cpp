#include "scene/light_documents.h"

#include "scene/direction.h"
#include "scene/ways.h"

namespace airlight {

Directional DirectionalDocument::light(const Cursor& at) const {
  Directional light;
  light.irradiance = *irradiance;
  light.angular_diameter = angular_diameter;
  if (way_taken(at, {{"direction"}, {"azimuth", "elevation"}}) == 1) {
    light.direction = -toward_sky(*azimuth, *elevation);
    return light;
  }
  const auto unit = unit_vector(*direction);
  if (!unit)
    at.at_or_here("direction").refuse("is no direction: at least one number must not be 0");
  light.direction = *unit;
  return light;
}

}  // namespace airlight
