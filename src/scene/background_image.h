#pragma once
#include <filesystem>

#include "scene/cursor.h"
#include "scene/scene.h"

namespace airlight {

/// Reads a picture that stands behind a scene, as linear light. Throws Error, at the key, if it
/// cannot be read, is not of the given size or is not finite everywhere.
Image load_background_image(const std::filesystem::path& path, Resolution size, const Cursor& at);

}  // namespace airlight
