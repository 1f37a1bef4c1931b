#pragma once
#include <airlight/estimators.h>

#include <vector>

#include "geometry/parallel_shadows.h"
#include "geometry/world.h"
#include "render/film.h"
#include "render/path_count.h"
#include "scene/camera.h"

namespace airlight {

/// Whether a path may go on from a light's samples.
inline bool paths_go_on_from(const Lights& light) noexcept {
  return std::visit([](const Light auto& l) { return l.everywhere; }, light);
}

/// How light that scatters more than once is followed.
struct PathSettings {
  int max_depth = 1;  ///< scattering in the medium and bounces off surfaces that are followed, >= 1
  /// Lights from whose samples paths go on; 0: from a free flight of their own.
  int sample_sources = 0;
  SurfaceSums surface = SurfaceSums::split;
  /// Paths that carry less than this are ended at random, > 0.
  double roulette_below = 0.25;
};

/// Everything a kernel needs of a scene, prepared once a picture. It refers to the scene and the
/// world.
struct Frame {
  const Scene& scene;
  const World& world;
  CameraFrame camera;
  Estimators estimator;
  PathSettings paths = {};
  PixelFilter filter = PixelFilter::tent;
  LightSelection light_selection = LightSelection::all;
  bool through_centre = false;  ///< every sample of a pixel shares the ray through its centre
  /// Samples that a camera ray is traced for; where all share one, what is taken of it at a time.
  std::uint32_t samples_per_ray = 1;
  std::uint32_t samples_per_surface_ray =
      1;  ///< samples of a camera ray that share a surface's shadow ray to a light with a disc
  std::uint32_t seed = 0;
  std::vector<ParallelShadows> shadows = {};  ///< one a light, for the exact estimator only
  FilmLayout layout = {};                     ///< of the films that are rendered into
  std::vector<int> light_group = {};          ///< of each light

  /// Whether a sample is in the half of the samples that its ray is in. Through the centre the
  /// sample itself decides: its first ray may be the only one. How many samples there will be does
  /// not count, so that a film has one kind of halves, whatever is added to it.
  bool halves_by_ray() const noexcept { return !through_centre; }

  /// The group of what belongs to no light's group: background, ambient light, emission.
  static constexpr int ungrouped = 0;
};

/// A part of the picture that one worker renders, straight into the film: no other worker has these
/// pixels.
struct Tile {
  PixelRect rect;  ///< of the film, from its own corner: one of the film's tiles
  SampleRange samples;
  Film& film;
  std::int64_t rejected = 0;  ///< pixels whose sums were not finite and were left out
  PathCount paths = {};       ///< of max_depth above 1
};

}  // namespace airlight
