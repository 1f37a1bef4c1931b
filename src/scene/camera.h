#pragma once
#include "scene/cursor.h"
#include "scene/scene.h"

namespace airlight {

/// Where the rays of a picture start and how they spread: the direction of pixel coordinates (x, y)
/// is corner + x · right + y · down. It is not normalised: its part along the view axis is 1.
struct CameraFrame {
  Vec3<double> position, corner, right, down;

  Vec3<double> direction(double x, double y) const { return corner + right * x + down * y; }
};

CameraFrame camera_frame(const Camera& camera, Resolution resolution);

/// Throws Error for a camera that looks nowhere or whose up is parallel to its view.
void check_camera(const Camera& camera, const Cursor& at);

}  // namespace airlight
