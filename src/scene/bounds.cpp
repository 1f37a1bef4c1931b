#include "scene/bounds.h"

namespace airlight {

Bounds bounds_of(const std::vector<Object>& objects) {
  Bounds bounds;
  for (const Object& object : objects) {
    if (const auto* mesh = std::get_if<Mesh>(&object.geometry)) {
      for (const auto& triangle : mesh->triangles)
        for (const std::uint32_t vertex : triangle)
          bounds.extend(Vec3<double>(mesh->positions[vertex]));
    } else {
      const auto& [centre, radius] = std::get<Sphere>(object.geometry);
      const Vec3<double> half(radius, radius, radius);
      bounds.extend(centre - half);
      bounds.extend(centre + half);
    }
  }
  return bounds;
}

}  // namespace airlight
