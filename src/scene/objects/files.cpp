#include "scene/objects/files.h"

namespace airlight {

const ModelFile& Files::open(const std::filesystem::path& file) const {
  const std::filesystem::path path = folder / file;
  const auto found = cache->models.find(path);
  if (found != cache->models.end()) return found->second;
  return cache->models.emplace(path, ModelFile(path)).first->second;
}

Model Files::model(const std::filesystem::path& file) const {
  const ModelFile& opened = open(file);
  if (keep) return opened.at(seconds);
  auto node = cache->models.extract(folder / file);
  return std::move(node.mapped()).at(seconds);
}

Texture Files::texture(const std::filesystem::path& file) const {
  const std::filesystem::path path = folder / file;
  if (!keep) return load_texture(path);
  const auto found = cache->textures.find(path);
  if (found != cache->textures.end()) return found->second;
  return cache->textures.emplace(path, load_texture(path)).first->second;
}

}  // namespace airlight
