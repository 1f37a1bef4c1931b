#pragma once
#include <airlight/estimator.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <string>
#include <vector>

#include "image/picture.h"
#include "render/film_layout.h"
#include "render/holdout_sums.h"
#include "render/zeroed_memory.h"
#include "scene/scene.h"

namespace airlight {

/// What a pixel has gathered, of one light group: sums in which every sample counts once.
struct PixelSums {
  Halves<double>
      in_scatter;  ///< light scattered or emitted by the medium, in two halves of the samples
  std::array<double, 2> samples{};  ///< how many are in each half
  Rgb<double> surface;           ///< light from surfaces and the background, dimmed by the medium
  HoldoutSums<double> holdouts;  ///< the background in the place of holdouts, if it is not there
  HoldoutLight<double> holdout_light;
  Rgb<double> shadow{1.};     ///< what the light of all groups leaves of that background
  Rgb<double> transmittance;  ///< what passes from the background, also where holdouts show it
  Rgb<double> albedo;         ///< of the first surface
  Vec3<double> normal;        ///< of the first surface, towards the camera
  double depth = 0;   ///< of the first surface on the pixel's first ray; 0 where there is none  [m]
  double object = 0;  ///< 1 + the index of that surface's object; 0 where there is none

  double sample_count() const { return samples[0] + samples[1]; }

  /// Light from surfaces and from the background, also where holdouts show that.
  Rgb<double> visible() const { return surface + holdouts.plate * shadow; }
};

/// The in-scatter of a pixel over both halves, divided by the number of samples.
Estimate<double> mean_estimate(const PixelSums& pixel);

/// A rectangle of pixels.
struct PixelRect {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};

/// Samples of one seed that a film holds: in every tile the next ones from the first on.
struct SampleRun {
  std::uint32_t seed = 0;
  std::uint32_t first = 0;
  std::vector<std::uint32_t> counts;  ///< of each tile

  std::uint32_t least() const { return std::ranges::min(counts); }  ///< that every pixel has
  std::uint32_t most() const { return std::ranges::max(counts); }
};

/// The sums of a picture or of a crop of it. Sums of disjoint sample ranges of the same seed can be
/// added, and those of different seeds. It is rendered tile by tile.
class Film {
 public:
  static constexpr int tile_side = 16;  ///< pixels

  /// Keeps everything, of lights without a group.
  Film(Resolution full, PixelRect crop);

  /// `groups`: names of the light groups, the first one empty: what belongs to none.
  Film(Resolution full, PixelRect crop, FilmLayout layout, std::vector<std::string> groups);

  Resolution full;  ///< of the whole picture
  PixelRect crop;   ///< the part that the film holds
  FilmLayout layout;
  std::vector<std::string> groups;  ///< of lights; the first has no name
  std::vector<SampleRun> runs;      ///< what has been added, by seed and first sample

  /// Pixels of the crop, row by row, the top row first.
  std::size_t pixel_count() const noexcept {
    return std::size_t(crop.width) * std::size_t(crop.height);
  }
  /// The sums of one of them.
  PixelSums pixel(std::size_t index, int group = 0) const;
  /// All of them.
  auto pixels(int group = 0) const {
    return std::views::iota(std::size_t(0), pixel_count()) |
           std::views::transform([this, group](std::size_t i) { return pixel(i, group); });
  }

  /// Where the numbers of the pixel (x, y) of the crop begin, and those of its packet's others, if
  /// it is a packet's first.
  FilmPixels at(int x, int y) noexcept;

  /// Tiles of the crop, row by row; those at its right and lower ends may be smaller.
  int tile_count() const noexcept;
  PixelRect tile(int index) const noexcept;

  /// The numbers of a tile as bytes: how many, to memory, and from there.
  std::size_t tile_bytes(int index) const noexcept;
  void save_tile(int index, std::byte* to) const noexcept;
  void load_tile(int index, const std::byte* from) noexcept;

  /// Adds the samples of a film of the same scene, size and crop. Throws Error if they share some.
  void merge(const Film& other);

  /// Samples that every pixel has, and those of the pixels that have most.
  std::int64_t samples() const;
  std::int64_t most_samples() const;

  /// The beauty and every other layer, as something to write. It refers to the film, which must
  /// stay where and as it is: the layers share the row of pixels that one of them read last, and
  /// would show what it was. Its metadata tell the samples and their seeds.
  Picture picture() const;

  /// The radiance of one pixel of the crop: in-scatter, surfaces and background.
  Rgb<double> radiance(int x, int y) const;

  /// A layer of the picture by name as an image of its own: "beauty", "in_scatter", "surface", …
  Image layer(const std::string& name) const;

 private:
  struct Place {
    std::size_t block;
    int index;  ///< in its block
  };
  Place place(int x, int y) const noexcept;
  Place place(std::size_t index) const noexcept;

  /// Calls visit(numbers, count) for each piece of memory that holds numbers of a tile.
  template <class Self, class Visit>
  static void for_each_piece(Self& film, int index, Visit&& visit);

  std::size_t blocks_across_;
  std::vector<double, ZeroedMemory<double>> sums_;  ///< block by block, row by row of its numbers
  std::vector<float, ZeroedMemory<float>> features_;
  std::vector<std::uint32_t, ZeroedMemory<std::uint32_t>> samples_;
};

/// "640 x 180 pixels at 0,180 of 640 x 360".
std::string part_of(const Film& film);

}  // namespace airlight
