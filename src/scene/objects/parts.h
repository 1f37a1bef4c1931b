#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace airlight {

/// What an object of a scene file is made of: one part, or several with materials of their own.
/// Texture indices count from the first of `textures`.
struct Parts {
  std::vector<Object> objects;
  std::vector<Texture> textures;
  std::vector<std::string> remarks;  ///< what a model left open or lost, a sentence each
};

/// A single part of the standard material.
inline Parts single_part(std::variant<Mesh, Sphere> geometry) {
  Parts parts;
  parts.objects.push_back({"", std::move(geometry), {}});
  return parts;
}

}  // namespace airlight
