#include "scene/camera.h"

#include <cmath>

#include "scene/direction.h"

namespace airlight {

CameraFrame camera_frame(const Camera& camera, Resolution resolution) {
  const Vec3<double> forward = normalize(camera.target - camera.position);
  const Vec3<double> right = normalize(cross(forward, camera.up));
  const Vec3<double> up = cross(right, forward);
  const double half_height = std::tan(camera.fov * (pi / 360));
  const double pixel = 2 * half_height / resolution.height;
  return {camera.position, forward - right * (pixel * resolution.width / 2) + up * half_height,
          right * pixel, up * -pixel};
}

void check_camera(const Camera& camera, const Cursor& at) {
  const auto view = unit_vector(camera.target - camera.position);
  if (!view) at.complain("looks nowhere: its target equals its position", {"target", "position"});
  const auto up = unit_vector(camera.up);
  if (!up) at.at_or_here("up").refuse("is no direction: at least one number must not be 0");
  if (length(cross(*view, *up)) >= 1e-6) return;
  at.complain("looks along its up: give camera.up another direction", {"up", "target", "position"});
}

}  // namespace airlight
