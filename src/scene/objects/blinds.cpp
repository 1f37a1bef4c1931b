#include "scene/objects/blinds.h"

#include "scene/objects/build.h"

namespace airlight {

Parts BlindsObject::build(const Cursor&) const {
  const double angle = tilt * (pi / 180);
  const Vec3<double> across{0, slat_width * std::sin(angle), slat_width * std::cos(angle)};
  Mesh mesh;
  for (std::int64_t i = 0; i < slats; ++i) {
    const double y = height * (double(i) + 0.5) / double(slats);
    add_parallelogram(mesh, Vec3<double>{0, y, 0} - across * 0.5, across, {width, 0, 0});
  }
  return single_part(std::move(mesh));
}

}  // namespace airlight
