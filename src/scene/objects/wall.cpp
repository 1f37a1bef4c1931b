#include "scene/objects/wall.h"

#include "scene/objects/build.h"

namespace airlight {
namespace {

/// The i-th bar of a row of openings between `low` and `high` starts here.
double bar_start(double low, double high, std::int64_t openings, double bar, std::int64_t i) {
  const double opening = (high - low - bar * double(openings - 1)) / double(openings);
  return low + opening * double(i + 1) + bar * double(i);
}

}  // namespace

Parts WallObject::build(const Cursor& at) const {
  const auto [x0, y0] = window_min;
  const auto [x1, y1] = window_max;
  if (x1 <= x0 || y1 <= y0)
    at.complain("has no window: window_max must lie above window_min in x and y",
                {"window_max", "window_min"});
  if (x1 > width || y1 > height)
    at.complain("is too small: window_max must not lie beyond its width and height",
                {"window_max", "width", "height"});
  if (bar_width * double(columns - 1) >= x1 - x0 || bar_width * double(rows - 1) >= y1 - y0)
    at.complain("has no openings left: the bars are as wide as the window");
  Mesh mesh;
  const auto add = [&](double left, double bottom, double right, double top, double depth) {
    if (right > left && top > bottom)
      add_box(mesh, {left, bottom, -depth / 2}, {right, top, depth / 2});
  };
  add(0, 0, width, y0, thickness);
  add(0, y1, width, height, thickness);
  add(0, y0, x0, y1, thickness);
  add(x1, y0, width, y1, thickness);
  for (std::int64_t i = 0; i + 1 < columns; ++i) {
    const double x = bar_start(x0, x1, columns, bar_width, i);
    add(x, y0, x + bar_width, y1, bar_depth);
  }
  for (std::int64_t row = 0; row + 1 < rows; ++row) {
    const double y = bar_start(y0, y1, rows, bar_width, row);
    for (std::int64_t i = 0; i < columns; ++i) {
      const double left = i == 0 ? x0 : bar_start(x0, x1, columns, bar_width, i - 1) + bar_width;
      const double right = i + 1 == columns ? x1 : bar_start(x0, x1, columns, bar_width, i);
      add(left, y, right, y + bar_width, bar_depth);
    }
  }
  return single_part(std::move(mesh));
}

}  // namespace airlight
