#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace airlight {

/// What a model file from elsewhere gives: surfaces, and sometimes a camera and lights.
struct Model {
  std::vector<Object> objects;    ///< meshes in world space
  std::vector<Texture> textures;  ///< what the materials' indices mean
  std::optional<Camera> camera;   ///< the first of the file, if it has one
  std::vector<Directional> lights;
  std::vector<std::string> remarks;  ///< what was filled in or left out, a sentence each
};

/// A model that moves, as it stands at a time in seconds.
using MovingModel = std::function<Model(double seconds)>;

/// A model file, read and decoded once.
class ModelFile {
 public:
  /// Reads a Wavefront OBJ (with its MTL and textures) or a glTF 2.0 file (.gltf, .glb), told apart
  /// by the extension. Throws Error if the file is broken, has no triangles, or needs what is not
  /// supported.
  explicit ModelFile(const std::filesystem::path& path);

  /// The model, if it does not move.
  const Model* still() const { return std::get_if<Model>(&content_); }

  /// The model at a time. Throws Error if it is nowhere to be seen then.
  Model at(double seconds) const&;
  Model at(double seconds) &&;

 private:
  std::variant<Model, MovingModel> content_;
};

/// A model as it stands at the start.
Model load_model(const std::filesystem::path& path);

}  // namespace airlight
