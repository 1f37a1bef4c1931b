#pragma once
#include <airlight/cross_section.h>
#include <airlight/describe.h>

#include <array>
#include <variant>
#include <vector>

#include "scene/cursor.h"
#include "scene/required.h"

namespace airlight {

/// A round beam as a file says it.
struct CircleDocument {
  Required<double> radius;

  static constexpr auto name = "circle";
  static constexpr auto meaning = "a round beam";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("radius", &CircleDocument::radius, unit::metre, closed(1e-6, 1e6), "of the beam");
  }
};

/// A beam with four right angles.
struct RectangleDocument {
  Required<double> width;
  Required<double> height;

  static constexpr auto name = "rectangle";
  static constexpr auto meaning = "a beam with four right angles";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = RectangleDocument;
    field("width", &D::width, unit::metre, closed(1e-6, 1e6), "across the light's up");
    field("height", &D::height, unit::metre, closed(1e-6, 1e6), "along the light's up");
  }
};

/// A beam behind a stencil with straight edges.
struct PolygonDocument {
  Required<std::vector<std::array<double, 2>>> corners;

  static constexpr auto name = "polygon";
  static constexpr auto meaning = "a beam behind a stencil with straight edges";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field("corners", &PolygonDocument::corners, unit::metre, closed(-1e6, 1e6),
          "of a convex polygon, 3 to 32 in turn; x is right and y up of who looks along the beam");
  }
};

/// Every outline of a beam as a file says it.
using CrossSectionDocuments = std::variant<CircleDocument, RectangleDocument, PolygonDocument>;

/// What an outline means. Throws Error for a polygon that is not convex.
CrossSection cross_section_of(const CrossSectionDocuments& document, const Cursor& at);

}  // namespace airlight
