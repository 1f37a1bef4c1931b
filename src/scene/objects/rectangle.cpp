#include "scene/objects/rectangle.h"

#include "scene/direction.h"
#include "scene/objects/build.h"

namespace airlight {

Parts RectangleObject::build(const Cursor& at) const {
  const auto along_u = unit_vector(u), along_v = unit_vector(v);
  if (!along_u || !along_v || length(cross(*along_u, *along_v)) < 1e-6)
    at.complain("has no area: u and v must not be parallel or 0");
  Mesh mesh;
  add_parallelogram(mesh, corner, u, v);
  return single_part(std::move(mesh));
}

}  // namespace airlight
