#pragma once
#include <airlight/shapes.h>

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "scene/cursor.h"

namespace airlight {

/// A convex polyhedron as a file says it: planes, or points to span.
struct ConvexDocument {
  std::optional<std::vector<std::array<double, 4>>> planes;
  std::optional<std::vector<Vec3<double>>> points;

  static constexpr auto name = Convex::name;
  static constexpr auto meaning = Convex::meaning;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = ConvexDocument;
    field("planes", &D::planes, unit::none, any_number(),
          "[nx, ny, nz, h] keeps the side n.x <= h of a plane; n points out, of any length");
    field("points", &D::points, unit::metre, any_number(), "the polyhedron is their convex hull");
  }
};

/// Every shape of a medium as a file says it.
using ShapeDocuments = std::variant<Box, ConvexDocument, Unbounded>;

/// What a shape means. Throws Error for one without an inside or without an end.
Shapes shape_of(const ShapeDocuments& document, const Cursor& at);

}  // namespace airlight
