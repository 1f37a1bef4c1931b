#pragma once
#include <filesystem>
#include <map>
#include <memory>

#include "scene/cursor.h"
#include "scene/models/model.h"

namespace airlight {

/// Files that are read once and asked for often, by their paths.
struct FileCache {
  std::map<std::filesystem::path, ModelFile> models;
  std::map<std::filesystem::path, Texture> textures;
};

/// The files that a scene file names, at a moment of its animation.
struct Files {
  std::filesystem::path folder;  ///< of the scene file
  double seconds = 0;            ///< when models that move are looked at
  bool keep = false;             ///< for the next frame; else every file is handed over
  std::shared_ptr<FileCache> cache = std::make_shared<FileCache>();

  /// Where the file lies that the value at a cursor names: a relative path starts at the scene
  /// file, or, if an override said it, at the current folder.
  std::filesystem::path path(const std::string& file, const Cursor& at) const;

  /// A model file, which stays in the cache until its model is handed over. Throws Error if it
  /// cannot be read or is broken.
  const ModelFile& open(const std::filesystem::path& path) const;

  /// Its model. Throws Error.
  Model model(const std::filesystem::path& path) const;

  /// A picture. Throws Error.
  Texture texture(const std::filesystem::path& path) const;
};

}  // namespace airlight
