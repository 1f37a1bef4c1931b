#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

/// The parser of MTL files reads words as zeros. This reads the text before it, strictly; `file`
/// stands for it in what is said.

/// Throws Error at the first line Kd, Kt, Tf, d or Tr without its finite numbers. What to say of
/// numbers outside [0, 1], if there are any: these count as the nearest in it.
std::optional<std::string> check_mtl_numbers(std::string_view text, const std::string& file);

/// The text with all that it means said:
/// * three numbers after Kd, Kt and Tf where a line gives one, which stands for all, and after the
///   options -o, -s and -t of textures: the parser takes zeros, or the file's name, for what is
///   missing;
/// * Kd for every material: white beside a picture, without one grey, which are added to
///   `colourless`; the parser takes 0.6 and black;
/// * names of materials with `joint` for blanks, as in a prepared OBJ file.
std::string complete_mtl(std::string_view text, std::vector<std::string>& colourless);

}  // namespace airlight
