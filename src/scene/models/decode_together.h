#pragma once
#include <functional>
#include <span>
#include <vector>

#include "image/texture.h"

namespace airlight {

/// Runs every loader, on all cores, and keeps their order. If some throw, the first in order is the
/// one reported.
std::vector<Texture> decode_together(std::span<const std::function<Texture()>> loaders);

}  // namespace airlight
