#include "geometry/exact_surfaces.h"

#include <tuple>

#include "scene/scene.h"

namespace airlight {

ExactSurfaces::ExactSurfaces(const Scene& scene, Among among) {
  const auto below = [](Vec3<double> a, Vec3<double> b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  for (std::uint32_t id = 0; id < scene.objects.size(); ++id) {
    const Object& object = scene.objects[id];
    if (among == Among::holdouts && !object.holdout) continue;
    if (const auto* sphere = std::get_if<Sphere>(&object.geometry)) {
      balls_.push_back({sphere->centre, sphere->radius, id});
      continue;
    }
    const Mesh& mesh = std::get<Mesh>(object.geometry);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& corners = mesh.triangles[i];
      const Vec3<double> a(mesh.positions[corners[0]]), b(mesh.positions[corners[1]]),
          c(mesh.positions[corners[2]]);
      triangles_.push_back({.corners = {a, b, c},
                            .normal = cross(b - a, c - a),
                            .ascending = {below(a, b), below(b, c), below(c, a)},
                            .object = id,
                            .primitive = i});
    }
  }
}

}  // namespace airlight
