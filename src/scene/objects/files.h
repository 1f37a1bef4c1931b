#pragma once
#include <filesystem>
#include <functional>

#include "scene/models/model.h"

namespace airlight {

/// Where the files are that a scene file names, and how models among them are loaded.
struct Files {
  std::filesystem::path folder;  ///< relative paths start here
  std::function<Model(const std::filesystem::path&)> model = load_model;
};

}  // namespace airlight
