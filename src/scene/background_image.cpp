#include "scene/background_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "image/input.h"
#include "image/resize.h"
#include "scene/proportions.h"

namespace airlight {

Image load_background_image(const std::filesystem::path& path, Resolution size, const Cursor& at,
                            std::vector<std::string>& remarks) {
  Image image;
  try {
    image = read_image(path);
  } catch (const Error& error) {
    at.complain(std::string("names a picture that is not to be had: ") + error.what());
  }
  if (!have_same_proportions(image, size))
    at.complain(fmt::format(
        "names a picture of other proportions: {} is {} x {} pixels; accepted: {} x {}, the "
        "picture's, or a size of the same proportions",
        path.string(), image.width, image.height, size.width, size.height));
  const auto bad =
      std::ranges::find_if_not(image.pixels, [](float value) { return std::isfinite(value); });
  if (bad != image.pixels.end()) {
    const std::size_t pixel = std::size_t(bad - image.pixels.begin()) / 3;
    at.complain(fmt::format(
        "names a picture with a hole: {} is {} at pixel {},{}; accepted: finite numbers",
        path.string(), *bad, pixel % std::size_t(image.width), pixel / std::size_t(image.width)));
  }
  if (image.width == size.width && image.height == size.height) return image;
  remarks.push_back(fmt::format("{} is {} x {} pixels and is shown at {} x {}", path.string(),
                                image.width, image.height, size.width, size.height));
  return resized(image, size.width, size.height);
}

}  // namespace airlight
