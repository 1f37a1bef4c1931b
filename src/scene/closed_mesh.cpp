#include "scene/closed_mesh.h"

#include "scene/closed_mesh/crossings.h"
#include "scene/closed_mesh/cut_bound.h"

namespace airlight {

std::shared_ptr<const ClosedMesh> close_mesh(
    std::span<const ClosedMesh::Point> points,
    std::span<const std::array<std::uint32_t, 3>> triangles) {
  closed_mesh::Soup soup = closed_mesh::welded(points, triangles);
  connect(soup);
  turn_out(soup);
  std::vector<Bounds> boxes(soup.triangles.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (int i = 0; i < 3; ++i) boxes[k].extend(soup.corner(k, i));
  OrderedBoxTree ordered = tree_over(boxes);
  check_crossings(soup, boxes, ordered);
  check_cuts(soup);
  const auto mesh = std::make_shared<ClosedMesh>();
  for (const Vec3<double>& p : soup.corners) mesh->corners.push_back({p.x, p.y, p.z});
  for (const std::size_t k : ordered.order) mesh->triangles.push_back(soup.triangles[k]);
  mesh->centre = {soup.centre.x, soup.centre.y, soup.centre.z};
  mesh->tree = std::move(ordered.tree);
  return mesh;
}

}  // namespace airlight
