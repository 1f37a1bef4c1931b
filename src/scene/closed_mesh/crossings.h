#pragma once
#include "scene/closed_mesh/tree.h"

namespace airlight::closed_mesh {

/// Throws Error if triangles cross, but at edges and corners that they share.
void check_crossings(const Soup& soup, const Tree& tree);

}  // namespace airlight::closed_mesh
