#pragma once
#include <filesystem>
#include <optional>
#include <string>
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

/// Reads a Wavefront OBJ (with its MTL and textures) or a glTF 2.0 file (.gltf, .glb), told apart
/// by the extension. Throws Error if the file is broken, has no triangles, or needs what is not
/// supported.
Model load_model(const std::filesystem::path& path);

}  // namespace airlight
