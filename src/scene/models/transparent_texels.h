#pragma once
#include "image/texture.h"

namespace airlight {

/// Whether any texel lets light through, so that its alpha is worth asking for.
inline bool has_transparent_texels(const Texture& texture) {
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] < 255) return true;
  return false;
}

}  // namespace airlight
