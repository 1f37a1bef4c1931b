#pragma once
#include <cstdint>

namespace airlight {

/// What following paths came to.
struct PathCount {
  std::int64_t vertices = 0;  ///< segments of paths, each with the light at its end and along it
  std::int64_t offered = 0;   ///< lanes that the packets of segments had, in use or not

  PathCount& operator+=(const PathCount& other) noexcept {
    vertices += other.vertices, offered += other.offered;
    return *this;
  }
};

}  // namespace airlight
