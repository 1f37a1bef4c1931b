#pragma once
#include <airlight/closed_mesh.h>
#include <airlight/math/vec.h>

#include <span>
#include <string>

namespace airlight::closed_mesh {

using Vec = Vec3<double>;
using Triangle = std::array<std::uint32_t, 3>;

/// What is to become a body.
struct Soup {
  std::vector<Vec> corners;  ///< about `centre`
  std::vector<Triangle> triangles;
  std::vector<std::size_t> numbers;     ///< of the triangles in the file, from 0
  std::vector<std::size_t> components;  ///< of the triangles
  std::size_t component_count = 0;
  Vec centre;
  double size = 0;  ///< the largest distance of a corner from the centre

  const Vec& corner(std::size_t triangle, int i) const {
    return corners[triangles[triangle][std::size_t(i % 3)]];
  }
  /// For messages: a point as the file says it.
  std::string place(const Vec& p) const;
};

/// Corners at the same place become one, about the middle of all. Throws Error if no triangle is
/// left.
Soup welded(std::span<const ClosedMesh::Point> points, std::span<const Triangle> triangles);

/// Turns neighbours to the same side and finds what hangs together. Throws Error if an edge belongs
/// to more or fewer than two triangles, or what hangs together has one side only.
void connect(Soup& soup);

/// Shells turn their outside to where the medium is not: every second one of those inside each
/// other.
void turn_out(Soup& soup);

}  // namespace airlight::closed_mesh
