#include "scene/objects/keys.h"

#include <airlight/math/rotation.h>

#include "scene/models/transparent_texels.h"
#include "scene/named_texture.h"

namespace airlight {
namespace {

/// Adds a picture to the parts' textures; returns its index.
int add_texture(Parts& parts, const std::string& file, const Cursor& at, const Files& files) {
  parts.textures.push_back(named_texture(file, at, files));
  return int(parts.textures.size()) - 1;
}

}  // namespace

void PlacedObject::place(Parts& parts, const char* kind) const {
  const Rotation turn(rotate);
  const auto moved = mapping();
  for (Object& object : parts.objects) {
    if (object.name.empty())
      object.name = label.empty() ? kind : label;
    else if (!label.empty())
      object.name = label + "." + object.name;
    object.holdout = holdout;
    if (is_none()) continue;
    if (auto* sphere = std::get_if<Sphere>(&object.geometry)) {
      sphere->centre = moved(sphere->centre);
      sphere->radius *= scale;
    } else {
      Mesh& mesh = std::get<Mesh>(object.geometry);
      for (auto& p : mesh.positions) p = Vec3<float>(moved(Vec3<double>(p)));
      for (auto& n : mesh.normals) n = Vec3<float>(turn(Vec3<double>(n)));
    }
  }
}

void SurfacedObject::paint(Parts& parts, const Cursor& at, const Files& files) const {
  std::optional<int> albedo_index, opacity_index;
  if (albedo_texture)
    albedo_index = add_texture(parts, *albedo_texture, at.at_or_here("albedo_texture"), files);
  if (opacity_texture) {
    opacity_index = add_texture(parts, *opacity_texture, at.at_or_here("opacity_texture"), files);
    parts.textures[std::size_t(*opacity_index)].srgb = false;  // opacity is no colour
  }
  for (Object& object : parts.objects) {
    Material& material = object.material;
    if (albedo) material.albedo = *albedo;
    if (albedo_index) {
      material.albedo_texture = *albedo_index;
      if (!albedo) material.albedo = {1, 1, 1};  // the picture as it is
    }
    if (opacity) material.opacity = *opacity;
    if (opacity_index) {
      material.opacity_texture = *opacity_index;
      material.opacity_from_alpha =
          has_transparent_texels(parts.textures[std::size_t(*opacity_index)]);
    }
    if (cutoff) material.cutoff = *cutoff;
    if (tint) material.tint = *tint;
  }
}

}  // namespace airlight
