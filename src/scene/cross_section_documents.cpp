#include "scene/cross_section_documents.h"

namespace airlight {
namespace {

CrossSection cross_section_of(const CircleDocument& circle, const Cursor&) {
  return CrossSection::circle(*circle.radius);
}

CrossSection cross_section_of(const RectangleDocument& rectangle, const Cursor&) {
  return CrossSection::rectangle(*rectangle.width, *rectangle.height);
}

CrossSection cross_section_of(const PolygonDocument& document, const Cursor& at) {
  std::vector<Vec2<double>> corners;
  for (const auto& [x, y] : *document.corners) corners.push_back({x, y});
  const auto refuse = [&](const std::string& what) {
    at.at_or_here("corners").complain(
        what + "; accepted: the 3 to 32 corners [x, y] of a convex polygon, in turn");
  };
  if (corners.size() < 3 || corners.size() > CrossSection::max_sides)
    refuse("has " + std::to_string(corners.size()) + " corners");
  const CrossSection polygon = CrossSection::polygon(corners);
  const double size = std::max(polygon.high.x - polygon.low.x, polygon.high.y - polygon.low.y);
  double widest = 0;
  for (int i = 0; i < polygon.side_count; ++i) {
    const auto& [x, y, h] = polygon.sides[std::size_t(i)];
    if (!std::isfinite(h)) refuse("has the same corner twice in turn");
    for (const Vec2<double>& p : corners) {
      const double inside = h - (x * p.x + y * p.y);
      if (inside < -1e-9 * size) refuse("is not convex");
      widest = std::max(widest, inside);
    }
  }
  if (widest < 1e-6 * size) refuse("spans no area");
  return polygon;
}

}  // namespace

CrossSection cross_section_of(const CrossSectionDocuments& document, const Cursor& at) {
  return std::visit([&](const auto& outline) { return cross_section_of(outline, at); }, document);
}

}  // namespace airlight
