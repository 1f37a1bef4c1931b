#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace airlight {

/// All bytes of a file. Throws Error: "sun.png: cannot be read: No such file or directory".
std::vector<std::byte> read_file(const std::filesystem::path& path);

/// The same as text, as it stands in the file.
std::string read_text(const std::filesystem::path& path);

}  // namespace airlight
