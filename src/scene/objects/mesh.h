#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// The surfaces of a model file, each with its own material unless the scene says otherwise.
struct MeshObject : SurfacedObject {
  Required<std::string> file;

  static constexpr auto name = "mesh";
  static constexpr auto meaning = "the surfaces of a model file";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = MeshObject;
    field("file", &O::file, unit::none, any_number(),
          "a model (.obj, .gltf, .glb); its path starts at the scene file; cameras and lights in "
          "it do not count");
    SurfacedObject::describe(field);
  }

  /// Throws Error if the file cannot be read or is broken.
  Parts build(const Cursor& at, const Files& files) const;
};

}  // namespace airlight
