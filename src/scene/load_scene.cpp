#include "scene/load_scene.h"

#include <algorithm>
#include <cctype>

#include "error.h"
#include "scene/scene_document.h"
#include "scene/stand_in.h"

namespace airlight {
namespace {

Scene scene_of(Value document, const Files& files, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) apply(change, document);
  return scene_of(document, files);
}

/// A model by itself: the scene file that it stands for, changed as asked.
Scene scene_around(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  Model model = load_model(path);
  const StandIn stand_in = stand_in_for(model, path.filename().string());
  Files files{path.parent_path()};
  files.model = [&](const std::filesystem::path&) { return std::move(model); };
  Scene scene = scene_of(parse_document(stand_in.toml, path.string()), files, overrides);
  if (std::string remark = stand_in.remark(overrides); !remark.empty())
    scene.assumptions.push_back(std::move(remark));
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  if (extension == ".toml")
    return scene_of(read_document(path), Files{path.parent_path()}, overrides);
  if (extension == ".obj" || extension == ".gltf" || extension == ".glb")
    return scene_around(path, overrides);
  throw Error(path.string() + ": is no scene by its name; accepted: .glb, .gltf, .obj, .toml");
}

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides) {
  return scene_of(parse_document(text, name), Files{std::filesystem::path(name).parent_path()},
                  overrides);
}

}  // namespace airlight
