#include "scene/shape_documents.h"

#include <fmt/format.h>

#include "error.h"
#include "scene/corners.h"
#include "scene/polyhedron.h"
#include "scene/ways.h"

namespace airlight {
namespace {

Shapes shape_of(const Box& box, const Cursor& at) {
  check_corners(box.min, box.max, at);
  return box;
}

Shapes shape_of(const ConvexDocument& document, const Cursor& at) {
  const bool by_planes = way_taken(at, {{"planes"}, {"points"}}) == 0;
  try {
    return by_planes ? polyhedron_inside(*document.planes) : hull_of(*document.points);
  } catch (const Error& error) {
    at.at_or_here(by_planes ? "planes" : "points").complain(error.what());
  }
}

Shapes shape_of(const Unbounded& unbounded, const Cursor&) { return unbounded; }

}  // namespace

Shapes shape_of(const ShapeDocuments& document, const Cursor& at) {
  return std::visit([&](const auto& shape) { return shape_of(shape, at); }, document);
}

}  // namespace airlight
