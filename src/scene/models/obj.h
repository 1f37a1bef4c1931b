#pragma once
#include <filesystem>

#include "scene/models/model.h"

namespace airlight {

/// Reads a Wavefront OBJ file and the MTL and texture files it names: an object for each material,
/// in the order of their first use. Polygons are triangulated; lines, points and curves are passed
/// over.
Model load_obj(const std::filesystem::path& path);

}  // namespace airlight
