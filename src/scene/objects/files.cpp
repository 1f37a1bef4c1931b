#include "scene/objects/files.h"

namespace airlight {

std::filesystem::path Files::path(const std::string& file, const Cursor& at) const {
  return at.value().place.is_override() ? std::filesystem::path(file) : folder / file;
}

const ModelFile& Files::open(const std::filesystem::path& path) const {
  const auto found = cache->models.find(path);
  if (found != cache->models.end()) return found->second;
  return cache->models.emplace(path, ModelFile(path)).first->second;
}

Model Files::model(const std::filesystem::path& path) const {
  const ModelFile& opened = open(path);
  if (keep) return opened.at(seconds);
  auto node = cache->models.extract(path);
  return std::move(node.mapped()).at(seconds);
}

Texture Files::texture(const std::filesystem::path& path) const {
  if (!keep) return load_texture(path);
  const auto found = cache->textures.find(path);
  if (found != cache->textures.end()) return found->second;
  return cache->textures.emplace(path, load_texture(path)).first->second;
}

}  // namespace airlight
