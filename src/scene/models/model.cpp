#include "scene/models/model.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "scene/models/gltf.h"
#include "scene/models/obj.h"

namespace airlight {

Model load_model(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".obj") return load_obj(path);
  if (extension == ".gltf" || extension == ".glb") return load_gltf(path);
  throw Error(
      fmt::format("{}: \"{}\" is no model file; .obj, .gltf, .glb", path.string(), extension));
}

}  // namespace airlight
