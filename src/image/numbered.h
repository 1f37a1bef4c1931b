#pragma once
#include <cstdint>
#include <filesystem>

namespace airlight {

/// Whether a file's name has a run of # in it, where the number of a frame goes.
bool is_pattern(const std::filesystem::path& path);

/// The file of a frame: "out.0017.png" of "out.####.png" and 17. As many digits as there are #, or
/// more for a number that has more. A name without # stays as it is. Throws Error for a second run
/// of #.
std::filesystem::path numbered(const std::filesystem::path& pattern, std::int64_t frame);

}  // namespace airlight
