#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "image/image.h"
#include "scene/scene.h"

namespace airlight {

/// Whether an image shows the same part of the world as the picture, to less than one of its
/// pixels.
inline bool have_same_proportions(const Image& image, Resolution picture) {
  const auto [width, height] = picture;
  const std::int64_t off = std::int64_t(image.width) * height - std::int64_t(image.height) * width;
  return std::abs(off) < std::min(width, height);
}

}  // namespace airlight
