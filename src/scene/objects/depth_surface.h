#pragma once
#include "image/image.h"
#include "scene/camera.h"

namespace airlight {

/// The surfaces that a camera sees at the given depths. `depths` lie along the view axis, the
/// frame's pixels are theirs  [m]; 0: nothing is there.
///
/// Each pixel becomes a quadrilateral between its corners, at the mean depth of the pixels that
/// meet there; so rays through centres, of which pictures are full, meet no vertex, where they
/// could slip through by rounding. Where the larger depth of two neighbours is more than 1 +
/// `discontinuity` times the smaller, they share no corner: the camera sees no gap between them,
/// and light no wall. The picture is carried on by a pixel all around, as far as a pixel's filter
/// reaches. Texture coordinates run over the picture.
Mesh depth_surface(const Image& depths, const CameraFrame& frame, double discontinuity);

}  // namespace airlight
