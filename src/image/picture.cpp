#include "image/picture.h"

#include <algorithm>

namespace airlight {

Picture picture_of(const Image& image) {
  Picture picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.layers = {{"beauty", {"R", "G", "B"}, [&image](int y, std::span<float> row) {
                       std::ranges::copy(image.row(y), row.begin());
                     }}};
  return picture;
}

}  // namespace airlight
