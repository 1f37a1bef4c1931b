#include "scene/load_scene.h"

#include "error.h"
#include "scene/scene_document.h"

namespace airlight {
namespace {

Scene scene_of(Value document, const std::filesystem::path& path,
               const std::vector<Override>& overrides) {
  for (const Override& change : overrides) apply(change, document);
  return scene_of(document, Files{path.parent_path()});
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  if (path.extension() != ".toml")
    throw Error(path.string() + ": is no scene by its extension; accepted: .toml");
  return scene_of(read_document(path), path, overrides);
}

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides) {
  return scene_of(parse_document(text, name), name, overrides);
}

}  // namespace airlight
