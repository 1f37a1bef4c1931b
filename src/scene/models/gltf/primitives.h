#pragma once
#include <string>
#include <vector>

#include "scene/models/gltf/materials.h"
#include "scene/models/gltf/nodes.h"

namespace airlight::gltf {

/// Collects the triangles of a document in world space, a mesh for each material.
class Collector {
 public:
  /// `nodes`: all of the scene, where skins find their joints.
  Collector(const Document& document, const std::vector<GltfMaterial>& materials,
            const std::vector<PlacedNode>& nodes)
      : document_(document), materials_(materials), nodes_(nodes) {}

  /// Adds a node's mesh. Throws Error, with the place in the document, if an index or a position is
  /// no good.
  void add(const PlacedNode& node);

  /// What was collected, in the order of first use. `remarks` learns what was left out.
  std::vector<Object> finish(std::vector<std::string>& remarks);

 private:
  struct Part {
    std::size_t material;
    bool has_normals;
    Mesh mesh;
  };

  void add(const tinygltf::Primitive& primitive, const PlacedNode& node,
           const std::vector<Affine>* joints, const std::string& where);
  Part& part_for(std::size_t material, bool has_normals);

  const Document& document_;
  const std::vector<GltfMaterial>& materials_;
  const std::vector<PlacedNode>& nodes_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> copied_as_,
      copied_for_;  ///< where a vertex went, and for which primitive that counts
  std::uint32_t primitive_number_ = 0;
  std::size_t triangles_ = 0;
  bool saw_lines_ = false, saw_colours_ = false, saw_lost_joints_ = false;
};

}  // namespace airlight::gltf
