#pragma once
#include <array>
#include <vector>

#include "scene/models/gltf/document.h"
#include "scene/models/model.h"

namespace airlight::gltf {

/// A material and how its texture lies on a surface.
struct GltfMaterial {
  Material material;
  std::string name;
  int uv_set = 0;  ///< the texture's coordinates: TEXCOORD_0, TEXCOORD_1, ...
  std::array<float, 6> uv_map{
      1, 0, 0, 0, 1, 0};  ///< (u, v) ↦ (m0 u + m1 v + m2, m3 u + m4 v + m5), v downwards

  bool glows = false;               ///< gives off light, which is left out
  bool filters_by_texture = false;  ///< lets light through as a texture says, which is left out

  bool has_texture() const { return material.albedo_texture >= 0; }
};

/// The document's materials, at last that of primitives without one. Their textures are added to
/// `textures`: base colour, alpha and transmission count. Throws Error if a texture cannot be read.
std::vector<GltfMaterial> convert_materials(const Document& document,
                                            std::vector<Texture>& textures);

}  // namespace airlight::gltf
