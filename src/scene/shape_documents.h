#pragma once
#include <airlight/shapes.h>

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "scene/cursor.h"
#include "scene/objects/files.h"
#include "scene/required.h"
#include "scene/transform.h"

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

/// The inside of a watertight mesh as a file says it.
struct SolidDocument : Transform {
  Required<std::string> file;

  static constexpr auto name = Solid::name;
  static constexpr auto meaning = Solid::meaning;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = SolidDocument;
    field("file", &D::file, unit::none, any_number(),
          "a model (.obj, .gltf, .glb) whose triangles close off the medium: two at every edge, "
          "none through another; its path starts at the scene file");
    Transform::describe_of<SolidDocument>(field);
  }
};

/// Every shape of a medium as a file says it.
using ShapeDocuments = std::variant<Box, ConvexDocument, Unbounded, SolidDocument>;

/// What a shape means. Throws Error for one without an inside or without an end, and for a mesh
/// that closes off no body.
Shapes shape_of(const ShapeDocuments& document, const Cursor& at, const Files& files);

}  // namespace airlight
