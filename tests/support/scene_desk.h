#pragma once
#include "program.h"

namespace airlight::test {

/// A folder with a scene in it, to work on with the program.
struct SceneDesk {
  Folder folder;
  std::string scene;

  SceneDesk(const std::string& name, const std::string& text) : scene(folder / name) {
    write_bytes(scene, text);
  }

  std::string operator/(const std::string& name) const { return folder / name; }

  Outcome render(const std::string& output, std::vector<std::string> flags = {},
                 const Beside& beside = {}) const {
    flags.insert(flags.begin(), {"render", scene, "-o", folder / output});
    return run(flags, beside);
  }
};

}  // namespace airlight::test
