#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "image/image.h"

namespace airlight {

/// How an EXR file keeps the values of a layer.
enum class Storage {
  colour,  ///< half or single precision, as the user asks
  single,  ///< always 32 bit floats: depths, sums that are merged later
  id,      ///< 32 bit unsigned integers: whole numbers from 0 to 2^24, exact in a float
};

/// Some channels of a picture. Rows are produced when they are asked for, so that what holds them
/// (a film) needs no second copy of itself.
struct Layer {
  std::string name;  ///< prefix of the EXR channels ("depth" gives depth.Z) and word in errors
  std::vector<std::string> channels;  ///< such as R, G, B, or X, Y, Z, or Z
  /// Writes row y (0 on top): width * channels values, interleaved. All layers of a picture
  /// together are asked by one thread at a time, in any order of layers and rows. They may share
  /// what is read of a row: who asks all layers for it before the next has it read once. A value
  /// that is not finite makes the writer throw an Error with layer and pixel.
  std::function<void(int y, std::span<float> row)> fill;
  Storage storage = Storage::colour;
};

/// Where a cropped picture lies inside the whole one, in pixels from its top left corner.
struct Crop {
  int x0 = 0;
  int y0 = 0;
  int full_width = 0;
  int full_height = 0;
};

using MetadataValue = std::variant<std::string, double, std::int64_t>;

/// What gets written. The first layer is the beauty with channels R, G, B; PFM keeps only this one,
/// PNG this and alpha.
struct Picture {
  int width = 0;
  int height = 0;
  std::optional<Crop> crop;  ///< none: the picture is whole
  std::vector<Layer> layers;
  std::vector<std::pair<std::string, MetadataValue>>
      metadata;  ///< such as {"spp", 64}; EXR and PNG keep it
  /// The part of the background that is covered, by which the beauty is multiplied. EXR and PNG
  /// keep it.
  std::optional<Layer> alpha = {};
};

/// Asks the layer for row y of the picture that goes to `path`. Throws Error naming layer, channel
/// and pixel for a value that is not finite, or no id where ids are kept.
void fill_row(const Layer& layer, int y, std::span<float> row, const std::filesystem::path& path);

/// Gives alpha to a picture whose beauty has no background in it: 1 − the mean over the channels of
/// its layer "transmittance", times "shadow" if it has that. In those layers, channels may differ;
/// alpha is one number.
void add_alpha(Picture& picture);

/// One layer, "beauty", that reads an RGB image, which must outlive the picture.
Picture picture_of(const Image& image);

}  // namespace airlight
