#pragma once
#include <map>
#include <string>
#include <vector>

#include "scene/models/gltf/document.h"

namespace airlight::gltf {

/// Nodes that stand otherwise than their document says, by their index.
using Poses = std::map<int, tinygltf::Node>;

/// The translations, rotations, scales and weights of morph targets that a document's animations
/// give its nodes (glTF 2.0 section 3.11). All animations play together, from their start; before
/// its first key and after its last a value is held.
class Motion {
 public:
  /// Reads all keys. `remarks` learns what is left out. Throws Error, with the place in the
  /// document, for keys that are broken.
  Motion(const Document& document, std::vector<std::string>& remarks);

  /// Whether nothing moves.
  bool empty() const { return channels_.empty(); }

  /// The nodes that move, at a time in seconds.
  Poses poses(double seconds) const;

 private:
  enum class Path { translation, rotation, scale, weights };
  enum class Way { linear, step, cubic_spline };

  /// One property of one node.
  struct Channel {
    int node;
    Path path;
    Way way;
    std::vector<double> times;  ///< of the keys, ascending  [s]
    /// As many for each key; of a cubic spline 3 times that: slope in, value, slope out.
    std::vector<double> values;

    std::vector<double> at(double seconds) const;
  };

  void add(const Document& document, const Json& animation, const Json& channel,
           const std::string& where);

  std::map<int, tinygltf::Node> at_rest_;
  std::vector<Channel> channels_;
};

}  // namespace airlight::gltf
