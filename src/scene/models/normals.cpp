#include "scene/models/normals.h"

#include <cmath>

namespace airlight {
namespace {

/// Makes it one long, if it has a direction.
bool normalise(Vec3<float>& n) {
  const double x = n.x, y = n.y, z = n.z;
  const double squared = x * x + y * y + z * z;
  if (!(squared > 0 && std::isfinite(squared))) return false;
  n = Vec3<float>(Vec3<double>(x, y, z) * (1 / std::sqrt(squared)));
  return true;
}

/// The direction a triangle faces, of any length.
Vec3<float> across(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto corner = [&](int i) { return Vec3<double>(mesh.positions[triangle[std::size_t(i)]]); };
  const Vec3<double> n = cross(corner(1) - corner(0), corner(2) - corner(0));
  return Vec3<float>(n * (1 / std::fmax(length(n), 1e-300)));
}

}  // namespace

void mend_normals(Mesh& mesh) {
  std::vector<bool> lost(mesh.normals.size(), false);
  bool any_lost = false;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (!normalise(mesh.normals[i])) any_lost = lost[i] = true;
  if (!any_lost) return;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle)
      if (lost[i]) {
        Vec3<float> n = across(mesh, triangle);
        lost[i] = !normalise(n);
        mesh.normals[i] =
            lost[i] ? Vec3<float>(0, 1, 0) : n;  // of a triangle without area nobody sees it
      }
}

}  // namespace airlight
