#pragma once
#include "error.h"
#include "scene/cursor.h"
#include "scene/objects/files.h"

namespace airlight {

/// Reads the picture that a key names. Throws Error at the key if it cannot be read.
inline Texture named_texture(const std::string& file, const Cursor& at, const Files& files) {
  try {
    return files.texture(files.path(file, at));
  } catch (const Error& error) {
    at.complain(std::string("names a picture that is not to be had: ") + error.what());
  }
}

}  // namespace airlight
