#include "scene/models/gltf/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "error.h"
#include "scene/models/decode_together.h"
#include "scene/models/transparent_texels.h"

namespace airlight::gltf {
namespace {

Wrap wrap(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

Texture read_texture(const Document& document, int index, const std::string& where) {
  const tinygltf::Texture& texture = document.model.textures[std::size_t(index)];
  const std::string here = fmt::format("{}: {}: textures[{}]", document.file, where, index);
  if (texture.source < 0) throw Error(here + " has no source; a PNG or JPEG image");
  const tinygltf::Image& image = document.images[std::size_t(texture.source)];
  const std::string name = fmt::format("{}: images[{}]", document.file, texture.source);
  Texture decoded;
  if (image.bufferView >= 0) {
    decoded = decode_texture(document.view(image.bufferView, name), name);
  } else {
    decoded = decode_texture(read_uri(image.uri, document.folder, name + ".uri"), name);
  }
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = document.model.samplers[std::size_t(texture.sampler)];
    decoded.wrap_u = wrap(sampler.wrapS);
    decoded.wrap_v = wrap(sampler.wrapT);
  }
  return decoded;
}

/// The index among `textures` of each texture of the document that is a base colour, −1 for the
/// others.
std::vector<int> read_base_colours(const Document& document, std::vector<Texture>& textures) {
  std::vector<int> places(document.model.textures.size(), -1);
  std::vector<std::function<Texture()>> loaders;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const int index = document.model.materials[i].pbrMetallicRoughness.baseColorTexture.index;
    if (index < 0 || places[std::size_t(index)] >= 0) continue;
    places[std::size_t(index)] = int(textures.size() + loaders.size());
    loaders.push_back([&document, i, index] {
      return read_texture(document, index,
                          fmt::format("materials[{}].pbrMetallicRoughness.baseColorTexture", i));
    });
  }
  for (Texture& texture : decode_together(loaders)) textures.push_back(std::move(texture));
  return places;
}

std::array<double, 2> pair(const tinygltf::Value& extension, const char* key,
                           std::array<double, 2> otherwise) {
  if (!extension.Has(key)) return otherwise;
  const tinygltf::Value& list = extension.Get(key);
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: scale, then rotate, then shift.
void place_texture(const tinygltf::TextureInfo& info, GltfMaterial& to) {
  to.uv_set = info.texCoord;
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found == info.extensions.end() || !found->second.IsObject()) return;
  const tinygltf::Value& transform = found->second;
  const auto offset = pair(transform, "offset", {0, 0}), scale = pair(transform, "scale", {1, 1});
  const double angle =
      transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  to.uv_map = {float(c * scale[0]),  float(s * scale[1]), float(offset[0]),
               float(-s * scale[0]), float(c * scale[1]), float(offset[1])};
  if (transform.Has("texCoord")) to.uv_set = transform.Get("texCoord").GetNumberAsInt();
}

/// Glass, after the alpha of the material.
void let_through(const tinygltf::Material& from, GltfMaterial& to) {
  const auto found = from.extensions.find("KHR_materials_transmission");
  if (found == from.extensions.end() || !found->second.Has("transmissionFactor")) return;
  const double through = found->second.Get("transmissionFactor").GetNumberAsDouble();
  if (!(through > 0)) return;
  Material& material = to.material;
  to.filters_by_texture = to.has_texture() || found->second.Has("transmissionTexture");
  if (material.cutoff >= 0 &&
      material.opacity_texture < 0) {  // alpha cuts out all of it or nothing
    material.opacity = material.opacity < material.cutoff ? 0 : 1;
    material.cutoff = -1;
    if (material.opacity == 0) return;
  }
  if (material.cutoff >= 0) {  // what is left of a cut-out can only be opaque
    to.filters_by_texture = true;
    return;
  }
  material.opacity *= 1 - through;
  material.tint = material.albedo;
}

GltfMaterial convert(const tinygltf::Material& from, const std::vector<int>& places,
                     const std::vector<Texture>& textures) {
  const auto& pbr = from.pbrMetallicRoughness;
  GltfMaterial to;
  to.name = from.name;
  const auto& color = pbr.baseColorFactor;
  Material& material = to.material;
  material.albedo = {color[0], color[1], color[2]};
  if (pbr.baseColorTexture.index >= 0) {
    material.albedo_texture = places[std::size_t(pbr.baseColorTexture.index)];
    place_texture(pbr.baseColorTexture, to);
  }
  if (from.alphaMode != "OPAQUE") {
    material.opacity = color[3];
    if (from.alphaMode == "MASK") material.cutoff = from.alphaCutoff;
    if (to.has_texture() &&
        has_transparent_texels(textures[std::size_t(material.albedo_texture)])) {
      material.opacity_texture = material.albedo_texture;
      material.opacity_from_alpha = true;
    }
  }
  let_through(from, to);
  to.glows = std::ranges::any_of(from.emissiveFactor, [](double factor) { return factor > 0; });
  return to;
}

}  // namespace

std::vector<GltfMaterial> convert_materials(const Document& document,
                                            std::vector<Texture>& textures) {
  const std::vector<int> places = read_base_colours(document, textures);
  std::vector<GltfMaterial> materials;
  for (const tinygltf::Material& material : document.model.materials)
    materials.push_back(convert(material, places, textures));
  materials.push_back(convert(tinygltf::Material{}, places, textures));
  return materials;
}

}  // namespace airlight::gltf
