#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/models/gltf/accessor.h"
#include "scene/models/gltf/nodes.h"

namespace airlight::gltf {

/// Where the joints of a skin carry the mesh that is bound to them; none if one of them is not
/// among the nodes. Throws Error if the skin's matrices are no good.
std::optional<std::vector<Affine>> joints_of(const Document& document, int skin,
                                             const std::vector<PlacedNode>& nodes);

/// An accessor of one of the attributes, if it is there. Throws Error.
std::optional<Accessor> find_attribute(const Document& document,
                                       const std::map<std::string, int>& attributes,
                                       const std::string& name, int type, const std::string& where);

/// The vertices of a primitive in the world: shaped by its morph targets, then carried by joints,
/// where there are any, or else by its node (glTF 2.0 sections 3.7.2.2 and 3.7.3).
class Vertices {
 public:
  /// The primitive has positions. `joints`: of the node's skin, null without one. Throws Error,
  /// with `where`, if accessors are no good.
  Vertices(const Document& document, const tinygltf::Primitive& primitive, const PlacedNode& node,
           const std::vector<Affine>* joints, const std::string& where);

  std::size_t size() const { return positions_->size(); }
  bool have_normals() const { return normals_.has_value(); }

  /// Where a vertex is, and what it faces, of any length. Throws Error if no joint is where it
  /// should be bound to.
  std::pair<Vec3<double>, Vec3<double>> operator[](std::size_t i) const;

 private:
  /// What is added, times a weight.
  struct Target {
    double weight;
    std::optional<Accessor> positions, normals;
  };

  /// Up to four joints of each vertex, and how much each of them counts.
  struct Bond {
    Accessor joints, weights;
  };

  Affine to_world(std::size_t i) const;

  std::string where_;  ///< of what follows, for errors
  std::optional<Accessor> positions_, normals_;
  std::vector<Target> targets_;
  Affine node_to_world_;
  const std::vector<Affine>* joints_;
  std::vector<Bond> bonds_;
};

}  // namespace airlight::gltf
