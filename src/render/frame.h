#pragma once
#include <airlight/estimators.h>

#include <vector>

#include "geometry/parallel_shadows.h"
#include "geometry/world.h"
#include "render/film.h"
#include "scene/camera.h"

namespace airlight {

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
  FilmLayout layout = {};                     ///< of the films that are rendered into
  std::vector<int> light_group = {};          ///< of each light

  /// The group of what belongs to no light's group: background, ambient light, emission.
  static constexpr int ungrouped = 0;
};

/// A part of the picture that one worker renders, straight into the film: no other worker has these
/// pixels.
struct Tile {
  static constexpr int size = 16;  ///< pixels of a side

  PixelRect rect;  ///< of the film, from its own corner; begins at a multiple of `size`
  SampleRange samples;
  Film& film;
  std::int64_t rejected = 0;  ///< pixels whose sums were not finite and were left out
};

}  // namespace airlight
