#include "scene/objects/disc.h"

#include "scene/direction.h"

namespace airlight {

Parts DiscObject::build(const Cursor& at) const {
  const auto n = unit_vector(normal);
  if (!n) at.at_or_here("normal").refuse("is no direction: at least one number must not be 0");
  Vec3<double> u, v;
  orthonormal_basis(*n, u, v);
  Mesh mesh;
  mesh.positions.emplace_back(centre);
  mesh.uvs.push_back({0.5F, 0.5F});
  const auto count = std::uint32_t(corners);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count, c = std::cos(angle), s = std::sin(angle);
    mesh.positions.emplace_back(centre + (u * c + v * s) * radius);
    mesh.uvs.push_back({float(0.5 + 0.5 * c), float(0.5 + 0.5 * s)});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return single_part(std::move(mesh));
}

}  // namespace airlight
