#pragma once
#include <filesystem>
#include <vector>

#include "image/output.h"
#include "scene/document.h"
#include "verb.h"

/// The files a picture goes to and how it is brought there.
class Outputs {
 public:
  void declare(CLI::App& verb);

  /// Throws airlight::Error if a file could not be written or a flag has a wrong value.
  void check();

  /// Writes every file that can be written; then throws the first airlight::Error there was.
  void write(const airlight::Picture& picture) const;

  /// "sunroom.png, sunroom.exr".
  std::string names() const;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<airlight::Override> changes_;
  airlight::OutputOptions options_;
};
