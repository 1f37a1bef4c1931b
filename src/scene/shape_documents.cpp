#include "scene/shape_documents.h"

#include <fmt/format.h>

#include "error.h"
#include "scene/closed_mesh.h"
#include "scene/corners.h"
#include "scene/polyhedron.h"
#include "scene/ways.h"

namespace airlight {
namespace {

Shapes shape_of(const Box& box, const Cursor& at, const Files&) {
  check_corners(box.min, box.max, at);
  return box;
}

Shapes shape_of(const ConvexDocument& document, const Cursor& at, const Files&) {
  const bool by_planes = way_taken(at, {{"planes"}, {"points"}}) == 0;
  try {
    return by_planes ? polyhedron_inside(*document.planes) : hull_of(*document.points);
  } catch (const Error& error) {
    at.at_or_here(by_planes ? "planes" : "points").complain(error.what());
  }
}

Shapes shape_of(const Unbounded& unbounded, const Cursor&, const Files&) { return unbounded; }

Shapes shape_of(const SolidDocument& document, const Cursor& at, const Files& files) {
  const Cursor at_file = at.at_or_here("file");
  const auto load = [&] {
    try {
      return files.model(files.path(*document.file, at_file));
    } catch (const Error& error) {
      at_file.complain(std::string("names a model that is not to be had: ") + error.what());
    }
  };
  const Model model = load();
  const auto moved = document.mapping();
  std::vector<ClosedMesh::Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Object& object : model.objects) {
    const auto& mesh = std::get<Mesh>(object.geometry);
    const auto first = std::uint32_t(points.size());
    for (const Vec3<float>& position : mesh.positions) {
      const Vec3<double> p = moved(Vec3<double>(position));
      points.push_back({p.x, p.y, p.z});
    }
    for (const auto& [a, b, c] : mesh.triangles)
      triangles.push_back({first + a, first + b, first + c});
  }
  try {
    return Solid{close_mesh(points, triangles)};
  } catch (const Error& error) {
    at_file.refuse(error.what());
  }
}

}  // namespace

Shapes shape_of(const ShapeDocuments& document, const Cursor& at, const Files& files) {
  return std::visit([&](const auto& shape) { return shape_of(shape, at, files); }, document);
}

}  // namespace airlight
