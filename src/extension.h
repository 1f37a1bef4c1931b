#pragma once
#include <algorithm>
#include <filesystem>
#include <string>

namespace airlight {

/// ".png" of "picture.PNG": how a file's name ends, in lower case.
inline std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace airlight
