#include "scene/models/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "image/read_file.h"
#include "scene/models/gltf/check.h"

namespace airlight::gltf {
namespace {

/// A parser's message as one line.
std::string one_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<tinygltf::Image> list_images(const Json& document) {
  std::vector<tinygltf::Image> images;
  const auto list = document.find("images");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i) {
    tinygltf::Image image;
    image.uri = (*list)[i].value("uri", "");
    image.bufferView = (*list)[i].value("bufferView", -1);
    images.push_back(std::move(image));
  }
  return images;
}

/// Leaves the bytes to us: the parser reads files that nobody needs and does not check what it
/// reads.
tinygltf::Model parse_structure(Json document, const std::string& file) {
  for (const char* key : {"buffers", "images", "animations", "skins"}) document.erase(key);
  const std::string text = document.dump(-1, ' ', true, Json::error_handler_t::replace);
  tinygltf::Model model;
  std::string error, warning;
  if (!tinygltf::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                                unsigned(text.size()), ""))
    throw Error(fmt::format("{}: {}", file, one_line(error)));
  return model;
}

/// Takes the diffuse colour of the older kind of materials for the base colour.
void adopt_diffuse_colours(Json& document) {
  const auto list = document.find("materials");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i) {
    Json& material = (*list)[i];
    const Json extensions = material.value("extensions", Json::object());
    const auto gloss = extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (gloss == extensions.end()) continue;
    Json pbr = Json::object();
    if (gloss->contains("diffuseFactor")) pbr["baseColorFactor"] = gloss->at("diffuseFactor");
    if (gloss->contains("diffuseTexture")) pbr["baseColorTexture"] = gloss->at("diffuseTexture");
    material["pbrMetallicRoughness"] = std::move(pbr);
  }
}

}  // namespace

std::span<const std::byte> Document::view(int buffer_view, const std::string& where) const {
  const tinygltf::BufferView& view = model.bufferViews[std::size_t(buffer_view)];
  const std::span<const std::byte> buffer = buffers[view.buffer];
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    throw Error(fmt::format("{}: {}: bufferViews[{}] wants bytes {} to {} of a buffer of {}", file,
                            where, buffer_view, view.byteOffset, view.byteOffset + view.byteLength,
                            buffer.size()));
  return buffer.subspan(view.byteOffset, view.byteLength);
}

Document read_document(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::vector<std::byte> contents = read_file(path);
  const Chunks chunks = split_chunks(contents, file);
  Json json = parse_json(chunks.json, file);
  check_document(json, file);
  adopt_diffuse_colours(json);
  Buffers buffers(json, chunks.binary, path.parent_path(), file);
  return {file,
          path.parent_path(),
          std::move(contents),
          parse_structure(json, file),
          list_images(json),
          json.value("animations", Json::array()),
          json.value("skins", Json::array()),
          extensions_left_out(json),
          std::move(buffers)};
}

}  // namespace airlight::gltf
