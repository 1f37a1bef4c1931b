#include "scene/objects/boxes.h"

#include "scene/objects/build.h"

namespace airlight {

Parts BoxesObject::build(const Cursor& at) const {
  const Cursor list = at.at_or_here("boxes");
  if (boxes->empty()) list.complain("is empty: accepted is at least one box");
  Mesh mesh;
  for (std::size_t i = 0; i < boxes->size(); ++i) {
    const auto& [x0, y0, z0, x1, y1, z1] = (*boxes)[i];
    if (!(x1 > x0 && y1 > y0 && z1 > z0))
      list.element(i).refuse("is empty or inverted: the upper corner must lie above the lower one");
    add_box(mesh, {x0, y0, z0}, {x1, y1, z1});
  }
  return single_part(std::move(mesh));
}

}  // namespace airlight
