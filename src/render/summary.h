#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/film.h"
#include "scene/bounds.h"
#include "scene/scene.h"

namespace airlight {

/// A medium and how it looks from the camera.
struct MediumSummary {
  std::string shape, phase;      ///< with their parameters
  Rgb<double> albedo;            ///< sigma_s / sigma_t, 0 where nothing is extinguished
  Rgb<double> mean_free_path;    ///< 1 / sigma_t; infinite where that is 0  [m]
  std::optional<double> across;  ///< the longest way through the middle along x, y or z  [m]
  Rgb<double> optical_depth;     ///< of that way
  bool camera_inside = false;
  std::optional<double> enter, exit;  ///< along the middle of the picture, if it meets the fog  [m]
  double to_target = 0;               ///< fog between the camera and its target  [m]
};

/// A light and where it gets to.
struct LightSummary {
  std::string kind;
  Vec3<double> toward;  ///< unit vector
  Rgb<double> irradiance;
  double angular_diameter = 0;  ///< [degrees]
  std::optional<double>
      lit_part;  ///< of the fog that the camera sees, 0 to 1; none if it sees none
};

/// How much memory a render takes, in bytes.
struct MemorySummary {
  std::size_t geometry = 0;  ///< vertices and triangles
  std::size_t textures = 0;
  std::size_t hierarchy = 0;  ///< Embree's, estimated
  std::size_t film = 0;
  std::size_t total() const { return geometry + textures + hierarchy + film; }
};

/// What is in a scene and what to expect of it.
struct Summary {
  std::size_t objects = 0, triangles = 0, spheres = 0, holdouts = 0, textures = 0;
  Bounds bounds;                     ///< around all objects
  std::vector<MediumSummary> media;  ///< one each
  std::vector<LightSummary> lights;
  MemorySummary memory;
  std::vector<std::string> remarks;   ///< what is good to know, a sentence each
  std::vector<std::string> warnings;  ///< what is hardly meant to be so, a sentence each
};

/// Looks at a scene; casts a few thousand rays into it.
Summary summarise(const Scene& scene);

/// The warnings that need no ray.
std::vector<std::string> warnings_before(const Scene& scene);

/// What a finished picture warns of: that no light reaches the fog in it. Of one that
/// was cut short before every pixel had a sample, nothing.
std::vector<std::string> warnings_after(const Scene& scene, const Film& film);

}  // namespace airlight
