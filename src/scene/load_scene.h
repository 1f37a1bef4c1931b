#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "scene/document.h"
#include "scene/scene.h"

namespace airlight {

/// Loads a scene file (.toml) or a model (.obj, .gltf, .glb), after changing values by their paths.
/// Files that the scene names lie beside it, those that a change names start at the current folder.
/// What a model says nothing about (camera, light, fog) is made up and told in `assumptions`. If
/// something moves, the scene is that of one frame, render.frame. Throws Error, one line that says
/// where, what was found and what is accepted.
///
///     const Scene scene = load_scene("fog.toml", {"lights.0.irradiance=3", "render.frame=12"});
Scene load_scene(const std::filesystem::path& path, const std::vector<Override>& overrides = {});

/// The same from text; `name` stands for it in errors, and files it names are looked for beside it.
Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides = {});

/// The scenes of many frames from one file. The file, the models and the pictures it names are read
/// once. An override of a value holds against its animation.
///
///     const SceneFile film("destruction.toml", {"render.spp=64"});
///     for (int frame = 0; frame < 48; ++frame) use(render(film.scene(frame)));
class SceneFile {
 public:
  /// Throws Error, as `load_scene` does.
  explicit SceneFile(const std::filesystem::path& path, std::vector<Override> overrides = {});
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;

  /// The scene of a frame, counted from 0. Throws Error.
  Scene scene(std::int64_t frame) const;

  /// Throws what `scene` would throw for a value that is unknown, of another kind or out of its
  /// range in this frame, for its camera, for media that overlap, and for a picture behind it that
  /// is not there. It opens no file and builds no object: so that a long run fails early.
  void check(std::int64_t frame) const;

  class Content;  ///< what has been read

 private:
  std::vector<Override> overrides_at(std::int64_t frame) const;

  std::unique_ptr<const Content> content_;
  std::vector<Override> overrides_;
};

}  // namespace airlight
