#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/models/gltf/bytes.h"

namespace airlight::gltf {

/// A glTF file in memory. Its structure has been checked: types are right and indices name
/// something; what accessors and buffer views claim of their buffers has not.
struct Document {
  std::string file;                              ///< stands before every error
  std::filesystem::path folder;                  ///< relative URIs start here
  std::vector<std::byte> contents;               ///< of the file; the binary chunk is a part of it
  tinygltf::Model model;                         ///< without buffers, images, animations and skins
  std::vector<tinygltf::Image> images;           ///< only URI and buffer view
  Json animations, skins;                        ///< lists
  std::vector<std::string> extensions_left_out;  ///< used by it and read by nobody
  Buffers buffers;

  /// Bytes of a buffer view. Throws Error, `where` first, if its buffer does not have them.
  std::span<const std::byte> view(int buffer_view, const std::string& where) const;
};

/// Reads a .gltf or .glb file and the buffers it names. Throws Error.
Document read_document(const std::filesystem::path& path);

}  // namespace airlight::gltf
