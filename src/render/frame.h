#pragma once
#include <airlight/estimators.h>

#include <vector>

#include "geometry/parallel_shadows.h"
#include "geometry/world.h"
#include "render/film.h"

namespace airlight {

/// Where the rays of a picture start and how they spread: the direction of pixel coordinates (x, y)
/// is corner + x · right + y · down, not normalised.
struct CameraFrame {
  Vec3<double> position, corner, right, down;
};

/// Everything a kernel needs of a scene, prepared once a picture. It refers to the scene and the
/// world.
struct Frame {
  const Scene& scene;
  const World& world;
  CameraFrame camera;
  Estimators estimator;
  PixelFilter filter = PixelFilter::tent;
  bool through_centre = false;  ///< every sample of a pixel shares the ray through its centre
  /// Samples that a camera ray is traced for; where all share one, what is taken of it at a time.
  std::uint32_t samples_per_ray = 1;
  std::uint32_t samples_per_surface_ray =
      1;  ///< samples of a camera ray that share a surface's shadow ray to a light with a disc
  std::uint32_t seed = 0;
  std::vector<ParallelShadows> shadows = {};  ///< one a light, for the exact estimator only
};

/// A part of the picture that one worker renders, with its sums in double.
struct Tile {
  PixelRect rect;  ///< in pixels of the whole picture
  SampleRange samples;
  std::vector<PixelSums<double>::Row> pixels;  ///< row by row
};

}  // namespace airlight
