#pragma once
#include "scene/closed_mesh/soup.h"

namespace airlight::closed_mesh {

/// Proves that no plane cuts more triangles than a ray has room for. Throws Error if one may.
void check_cuts(const Soup& soup);

}  // namespace airlight::closed_mesh
