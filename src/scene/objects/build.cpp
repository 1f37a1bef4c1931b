#include "scene/objects/build.h"

namespace airlight {

using Vec = Vec3<double>;

void add_parallelogram(Mesh& mesh, Vec corner, Vec u, Vec v) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (const Vec& p : {corner, corner + u, corner + u + v, corner + v})
    mesh.positions.emplace_back(p);
  mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Mesh& mesh, Vec min, Vec max) {
  const Vec size = max - min;
  const Vec x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  add_parallelogram(mesh, min + z, x, y);       // +z
  add_parallelogram(mesh, min + x, -x, y);      // -z
  add_parallelogram(mesh, min + x + z, -z, y);  // +x
  add_parallelogram(mesh, min, z, y);           // -x
  add_parallelogram(mesh, min + y + z, x, -z);  // +y
  add_parallelogram(mesh, min, x, z);           // -y
}

}  // namespace airlight
