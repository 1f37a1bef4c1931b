#pragma once
#include <optional>
#include <vector>

#include "scene/affine.h"
#include "scene/models/gltf/motion.h"
#include "scene/models/model.h"

namespace airlight::gltf {

/// A node of the scene and where it stands.
struct PlacedNode {
  int node;  ///< index into the document's nodes
  Affine to_world;
  std::vector<double> weights = {};  ///< of its mesh's morph targets; 0 beyond its end
};

/// The nodes of the document's default scene, or else the first, or else all, parents before
/// children, posed as told. Throws Error if a node is its own ancestor or has two parents.
std::vector<PlacedNode> place_nodes(const Document& document, const Poses& poses);

/// The first perspective camera among the nodes. `remarks` learns of others if there is none.
std::optional<Camera> find_camera(const Document& document, const std::vector<PlacedNode>& nodes,
                                  std::vector<std::string>& remarks);

/// The directional lights among the nodes. What else shines is named in a remark.
std::vector<Directional> find_lights(const Document& document, const std::vector<PlacedNode>& nodes,
                                     std::vector<std::string>& remarks);

}  // namespace airlight::gltf
