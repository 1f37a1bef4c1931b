#pragma once
#include <filesystem>
#include <vector>

#include "scene/document.h"
#include "scene/scene.h"

namespace airlight {

/// Loads a scene file (.toml) or a model (.obj, .gltf, .glb), after changing values by their paths.
/// What a model says nothing about (camera, light, fog) is made up and told in `assumptions`.
/// Throws Error, one line that says where, what was found and what is accepted.
///
///     const Scene scene = load_scene("fog.toml", {"lights.0.irradiance=3", "render.spp=64"});
Scene load_scene(const std::filesystem::path& path, const std::vector<Override>& overrides = {});

/// The same from text; `name` stands for it in errors, and files it names are looked for beside it.
Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides = {});

}  // namespace airlight
