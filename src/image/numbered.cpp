#include "image/numbered.h"

#include <fmt/format.h>

#include "error.h"

namespace airlight {

bool is_pattern(const std::filesystem::path& path) {
  return path.filename().string().find('#') != std::string::npos;
}

std::filesystem::path numbered(const std::filesystem::path& pattern, std::int64_t frame) {
  std::string name = pattern.filename().string();
  const std::size_t first = name.find('#');
  if (first == std::string::npos) return pattern;
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  if (name.find('#', end) != std::string::npos)
    throw Error(pattern.string() +
                ": has # in two places; accepted is one run of them, such as out.####.png");
  name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
  return pattern.parent_path() / name;
}

}  // namespace airlight
