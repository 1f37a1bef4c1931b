#pragma once
#include "scene/scene.h"

namespace airlight {

/// Gives every normal unit length; one that has no direction (zero, not finite) becomes that of a
/// triangle it belongs to. All triangles must have valid indices.
void mend_normals(Mesh& mesh);

}  // namespace airlight
