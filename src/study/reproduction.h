#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"
#include "report/check.h"
#include "report/page.h"

namespace airlight {

/// What a reproduction hands in while it runs.
struct Reproduced {
  std::filesystem::path folder;  ///< where its files go
  Page page;
  std::vector<Row> rows = {};             ///< every number that is held to a range
  std::filesystem::path scene_file = {};  ///< shown instead of its own scenes; empty: its own

  /// Writes an image as NAME.png into the folder and makes a figure of it.
  Figure picture(const std::string& name, const Image& image, const std::string& caption) const;
};

/// A figure or a claim of a paper, computed again: numbers that must lie in a range, and a page for
/// people to look at.
struct Reproduction {
  const char* name;   ///< paper/figure, such as "000/fig6-single"
  const char* title;  ///< of the page
  const char* shows;  ///< what the figure shows, in a sentence
  void (*run)(Reproduced& out);
  bool takes_scene = false;  ///< whether it can be shown on a scene of the user's
};

/// Runs one: writes index.html, result.json and its pictures into the folder, which is made if it
/// is missing, and returns the rows. A scene file, if there is one, takes the place of its own
/// scenes where it `takes_scene`. Throws Error if a file can't be written or the scene can't be
/// shown.
std::vector<Row> reproduce(const Reproduction& reproduction, const std::filesystem::path& folder,
                           const std::filesystem::path& scene_file = {});

}  // namespace airlight
