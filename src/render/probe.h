#pragma once
#include <airlight/estimate.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace airlight {

/// What happens along the camera rays of one pixel, for those who doubt or learn. All distances t
/// count from the camera, in metres.

/// One visibility sample.
struct ProbedSample {
  std::uint32_t index = 0;  ///< in its pixel
  double t = 0;             ///< [m]
  double pdf = 0;           ///< [1/m]
  Rgb<double> weight;       ///< transmittance over pdf  [m]
  Rgb<double> visibility;   ///< 0 shadowed, 1 lit
};

/// Where the way out has a kink: an end of a trapezoid.
struct ProbedNode {
  double t = 0;               ///< [m]
  double length = 0;          ///< in media, from the camera to here and on to the light  [m]
  Rgb<double> optical_depth;  ///< of that way
};

/// The middle of one of many equal steps.
struct ProbedStep {
  double t = 0;               ///< [m]
  double pdf = 0;             ///< of the placement; 0 for an estimator without samples  [1/m]
  Rgb<double> transmittance;  ///< from the light through here to the camera
  Rgb<double> visibility;     ///< along `toward`
};

/// One light along one camera ray.
struct ProbedLight {
  std::size_t light = 0;  ///< index into Scene::lights
  Vec3<double> toward;    ///< unit vector
  /// Of media in pieces, where what scatters changes along the ray: `strength` is then the light's
  /// irradiance [W/m2], and what scatters is part of integral and weights [1/sr].
  bool in_pieces = false;
  Rgb<double> strength;  ///< sigma_s times phase function times irradiance  [W/(m3 sr)]
  Rgb<double> transmittance_integral;  ///< T, along what the light reaches of it in the medium  [m]
  std::vector<ProbedNode> nodes;
  std::vector<ProbedSample> samples;
  std::vector<ProbedStep> steps;
  std::vector<std::pair<double, double>> lit;  ///< where a step sees the light  [m]
  Estimate<double> mean;                       ///< the sums of the samples over their number
};

/// One camera ray.
struct ProbedRay {
  Vec3<double> origin, direction;
  std::uint32_t sample_count = 0;
  std::optional<double> hit;      ///< the first surface  [m]
  std::size_t object = 0;         ///< of that surface, index into Scene::objects
  std::optional<double> end;      ///< the first opaque surface  [m]
  std::optional<double> t_enter;  ///< where the ray enters the medium, if it does  [m]
  double t_exit = 0;              ///< where it leaves the medium or meets the opaque surface  [m]
  Rgb<double> through;            ///< what reaches the camera from the ray's end
  Rgb<double> surface;            ///< radiance of surfaces and background at the camera
  Rgb<double> emission;           ///< radiance the medium itself emits, at the camera
  std::vector<ProbedLight> lights;
};

/// A pixel and its rays, computed in double by the renderer's own code: of light that scatters
/// once, also where the picture follows it further.
struct Probe {
  int x = 0, y = 0;
  std::string estimator;
  int max_depth = 1;  ///< how often light may scatter in the picture
  std::vector<ProbedRay> rays;
  Estimate<double> mean;   ///< the pixel's four sums over the number of samples, emission included
  Rgb<double> in_scatter;  ///< [W/(m2 sr)]
  Rgb<double> surface;     ///< [W/(m2 sr)]
  Rgb<double> radiance;    ///< their sum, what a picture of max_depth 1 shows  [W/(m2 sr)]
};

/// Probes a pixel of the picture; x counts from the left, y from the top. Throws Error if it is not
/// in the picture, for more than 1048576 samples, or where `render` would throw.
Probe probe(const Scene& scene, const RenderSettings& settings, int x, int y);

}  // namespace airlight
