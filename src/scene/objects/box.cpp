#include "scene/objects/box.h"

#include <airlight/math/rotation.h>

#include "scene/corners.h"
#include "scene/objects/build.h"

namespace airlight {

Parts BoxObject::build(const Cursor& at) const {
  check_corners(min, max, at);
  Mesh mesh;
  add_box(mesh, min, max);
  const Rotation turn(rotation);
  const Vec3<double> middle = (min + max) * 0.5;
  for (auto& p : mesh.positions) p = Vec3<float>(middle + turn(Vec3<double>(p) - middle));
  return single_part(std::move(mesh));
}

}  // namespace airlight
