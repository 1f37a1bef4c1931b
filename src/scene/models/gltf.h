#pragma once
#include <filesystem>

#include "scene/models/model.h"

namespace airlight {

/// Reads a glTF 2.0 file (.gltf or .glb) with the buffers and textures it names: the triangles of
/// its default scene, an object for each material, the first perspective camera and all directional
/// lights. Supported are base colour, alpha modes, animated nodes, KHR_lights_punctual,
/// KHR_materials_transmission, KHR_mesh_quantization and KHR_texture_transform; another extension
/// that the file requires is refused by name.
std::variant<Model, MovingModel> load_gltf(const std::filesystem::path& path);

}  // namespace airlight
