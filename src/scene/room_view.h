#pragma once
#include <optional>

#include "scene/bounds.h"
#include "scene/look_around.h"

namespace airlight {

/// Where one stands in a room, and where the sun, so that its light is seen coming in.
struct RoomView {
  Camera camera;
  double azimuth, elevation;  ///< of the sun, as in a scene file  [degrees]
  Bounds room;                ///< what to fill with fog
};

/// Stands at many places of a room and asks at each where the sky is seen: a sun there would light
/// this place. Of all suns and cameras it takes the pair that shows most light and shadow in the
/// air. `middle` is a panorama from the room's middle, `all` the bounds of everything. Where a
/// camera or the sun's direction is `given`, only the other is chosen.
RoomView room_view(const std::vector<Object>& objects, const Panorama& middle, const Bounds& all,
                   const std::optional<Camera>& given_camera,
                   const std::optional<Vec3<double>>& given_sun);

}  // namespace airlight
