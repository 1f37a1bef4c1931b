#pragma once
#include <string>
#include <vector>

#include "scene/cursor.h"

namespace airlight {

/// Keys that together say something which a table may also say by other keys.
using Way = std::vector<std::string>;

/// Which of the ways a table takes, as an index. All of its keys must be there and none of another
/// way's; but where overrides gave some of them, keys of the file that do not go with these give
/// way. Throws Error: "fog.toml:3:1: lights.0 has azimuth without elevation; accepted: ...".
std::size_t way_taken(const Cursor& at, const std::vector<Way>& ways);

}  // namespace airlight
