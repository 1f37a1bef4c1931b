#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace airlight {

/// All bytes of a file. Throws Error: "sun.png: cannot be read: No such file or directory".
std::vector<std::byte> read_file(const std::filesystem::path& path);

/// The same as text, without the mark of UTF-8 that editors on Windows put first.
std::string read_text(const std::filesystem::path& path);

}  // namespace airlight
