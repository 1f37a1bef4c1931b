#pragma once
#include <filesystem>

#include "scene/document.h"
#include "scene/scene.h"
#include "verb.h"

/// What every verb that takes a scene has in common: the file, changes of its values by their
/// paths, and a flag for every setting of a render.
class SceneFlags {
 public:
  void declare(CLI::App& verb);

  /// The scene with all changes made. Throws airlight::Error.
  airlight::Scene load() const;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::vector<airlight::Override> changes_;
};
