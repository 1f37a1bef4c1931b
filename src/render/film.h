#pragma once
#include <airlight/estimator.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "image/picture.h"
#include "scene/scene.h"

namespace airlight {

/// What a pixel has gathered, every sample counting once; `Real` is float in a film, double while a
/// tile is rendered, and a batch for a packet of pixels.
template <class Real>
struct PixelSums {
  Halves<Real>
      in_scatter;  ///< light scattered or emitted by the medium, in two halves of the samples
  std::array<Real, 2> samples{Real(0), Real(0)};  ///< how many are in each half
  Rgb<Real> surface;        ///< light from surfaces and the background, dimmed by the medium
  Rgb<Real> transmittance;  ///< of the medium and of glass up to the first opaque surface
  Rgb<Real> albedo;         ///< of the first surface
  Vec3<Real> normal;        ///< of the first surface, towards the camera
  Real depth =
      Real(0);  ///< of the first surface on the pixel's first ray; 0 where there is none  [m]
  Real object = Real(0);  ///< 1 + the index of that surface's object; 0 where there is none

  static constexpr std::size_t count = 40;  ///< numbers in all
  static constexpr std::size_t added =
      38;                               ///< the first ones, which add up; depth and object do not
  using Row = std::array<Real, count>;  ///< the same as one row of numbers

  Row row() const { return std::bit_cast<Row>(*this); }

  /// Adds another run's samples; the first surface stays that of the first run that has samples.
  template <class Other>
  void add(const std::array<Other, count>& other);

  Real sample_count() const { return samples[0] + samples[1]; }
};

/// A rectangle of pixels.
struct PixelRect {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};

/// The sums of a picture or of a crop of it. Sums of disjoint sample ranges of the same seed can be
/// added.
class Film {
 public:
  Film(Resolution full, PixelRect crop);

  Resolution full;                       ///< of the whole picture
  PixelRect crop;                        ///< the part that the film holds
  std::vector<PixelSums<float>> pixels;  ///< of the crop, row by row, the top row first

  /// Adds the samples of a film of the same scene, size and crop.
  void merge(const Film& other);

  /// The beauty and every other layer, as something to write; refers to the film.
  Picture picture() const;

  /// The radiance of one pixel of the crop: in-scatter, surfaces and background.
  Rgb<double> radiance(int x, int y) const;

  /// A layer of the picture by name as an image of its own: "beauty", "in_scatter", "surface", …
  Image layer(const std::string& name) const;
};

/// The sums of a pixel over both halves, divided by the number of samples.
Estimate<double> mean_estimate(const PixelSums<float>& pixel);

}  // namespace airlight
