#pragma once
#include <filesystem>

#include "scene/load_scene.h"
#include "verb.h"

/// What every verb that takes a scene has in common: the file, changes of its values by their
/// paths, and a flag for every setting of a render.
class SceneFlags {
 public:
  /// `without` are keys of the render settings that the verb has no flag for.
  void declare(CLI::App& verb, const std::vector<std::string>& without = {});

  /// Gives a value of the scene a default of the verb's own, which flags and -D still change.
  void preset(const std::string& path, const std::string& value);

  /// The scene with all changes made. Throws airlight::Error.
  airlight::Scene load() const;

  /// The file for many frames, and the scene of one of them. Throws airlight::Error.
  airlight::SceneFile open() const;
  airlight::Scene load(const airlight::SceneFile& file, std::int64_t frame) const;

  /// Prints to stderr what was assumed for a scene and the warnings that need no ray.
  static void tell(const airlight::Scene& scene);

  const std::filesystem::path& file() const { return file_; }

  /// The flag that changed a value last, as it was given; empty if none did.
  std::string said(const std::string& path) const;

 private:
  /// The scene, if its estimator is known. Throws airlight::Error, at the flag that named it.
  airlight::Scene checked(airlight::Scene scene) const;

  std::filesystem::path file_;
  std::vector<airlight::Override> changes_;
};
