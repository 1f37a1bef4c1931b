#include "scene/models/model.h"

#include <fmt/format.h>

#include "error.h"
#include "extension.h"
#include "scene/models/gltf.h"
#include "scene/models/obj.h"

namespace airlight {
namespace {

std::variant<Model, MovingModel> read(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") return load_obj(path);
  if (extension == ".gltf" || extension == ".glb") return load_gltf(path);
  throw Error(
      fmt::format("{}: \"{}\" is no model file; .obj, .gltf, .glb", path.string(), extension));
}

}  // namespace

ModelFile::ModelFile(const std::filesystem::path& path) : content_(read(path)) {}

Model ModelFile::at(double seconds) const& {
  const auto* moving = std::get_if<MovingModel>(&content_);
  return moving ? (*moving)(seconds) : std::get<Model>(content_);
}

Model ModelFile::at(double seconds) && {
  const auto* moving = std::get_if<MovingModel>(&content_);
  return moving ? (*moving)(seconds) : std::get<Model>(std::move(content_));
}

Model load_model(const std::filesystem::path& path) { return ModelFile(path).at(0); }

}  // namespace airlight
