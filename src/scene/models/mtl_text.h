#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace airlight {

/// The parser of MTL files reads words as zeros. This reads the text before it, strictly; `file`
/// stands for it in what is said.

/// Throws Error at the first line Kd, Kt, Tf, d or Tr without its finite numbers. What to say of
/// numbers outside [0, 1], if there are any: these count as the nearest in it.
std::optional<std::string> check_mtl_numbers(std::string_view text, const std::string& file);

/// The text with three numbers after Kd, Kt and Tf where a line gives one, which stands for all,
/// and after the options -o, -s and -t of textures: the parser takes zeros, or the file's name, for
/// what is missing.
std::string complete_mtl_numbers(std::string_view text);

}  // namespace airlight
