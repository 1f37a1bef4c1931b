#pragma once
#include <filesystem>

#include "scene/cursor.h"
#include "scene/scene.h"

namespace airlight {

/// Reads a picture that stands behind a scene, as linear light, and brings it to a size, of which
/// it tells in a remark. Throws Error, at the key, if it cannot be read, has other proportions or
/// is not finite everywhere.
Image load_background_image(const std::filesystem::path& path, Resolution size, const Cursor& at,
                            std::vector<std::string>& remarks);

}  // namespace airlight
