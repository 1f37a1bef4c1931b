#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/models/gltf/check.h"

namespace airlight::gltf {

/// The two chunks of a .glb file; a .gltf file is all JSON.
struct Chunks {
  std::string_view json;
  std::span<const std::byte> binary;
};

/// Finds the chunks of a file, by its first bytes. Throws Error if it is cut off or of another
/// version.
Chunks split_chunks(std::span<const std::byte> file, const std::string& name);

/// What a document's URI stands for: "data:...;base64,...", or a file in `folder`. `where` stands
/// before what an Error says.
std::vector<std::byte> read_uri(const std::string& uri, const std::filesystem::path& folder,
                                const std::string& where);

/// The contents of the document's buffers.
class Buffers {
 public:
  /// Reads them all. `binary`, the chunk of a .glb file, must outlive this. Throws Error.
  Buffers(const Json& document, std::span<const std::byte> binary,
          const std::filesystem::path& folder, const std::string& file);

  Buffers(Buffers&&) = default;

  std::span<const std::byte> operator[](int i) const { return spans_[std::size_t(i)]; }

 private:
  std::vector<std::vector<std::byte>> owned_;
  std::vector<std::span<const std::byte>> spans_;  ///< into owned_ or the binary chunk
};

}  // namespace airlight::gltf
