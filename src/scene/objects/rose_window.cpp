#include "scene/objects/rose_window.h"

#include <functional>

namespace airlight {
namespace {

using Vec = Vec3<double>;
/// A closed outline in the plane z = 0, counter-clockwise over [0, 1), seen from +z.
using Outline = std::function<Vec(double)>;

constexpr std::uint32_t outline_points = 48;

Vec raised(Vec p, double z) { return {p.x, p.y, z}; }

/// Stone between two outlines that go around the same point: front, back and the two reveals.
void add_frame(Mesh& mesh, const Outline& outer, const Outline& inner, double half) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t i = 0; i < outline_points; ++i) {
    const double t = double(i) / outline_points;
    const Vec a = outer(t), b = inner(t);
    for (const Vec& p : {raised(a, half), raised(b, half), raised(b, -half), raised(a, -half)})
      mesh.positions.emplace_back(p);
  }
  for (std::uint32_t i = 0; i < outline_points; ++i) {
    const std::uint32_t here = first + 4 * i, next = first + 4 * ((i + 1) % outline_points);
    for (std::uint32_t k = 0; k < 4; ++k) {  // front, inner reveal, back, outer reveal
      const std::uint32_t l = (k + 1) % 4;
      mesh.triangles.push_back({here + k, next + k, next + l});
      mesh.triangles.push_back({here + k, next + l, here + l});
    }
  }
}

/// Glass between two outlines, or inside one if there is no second.
void add_pane(Mesh& mesh, const Outline& outer, const Outline& inner) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t i = 0; i < outline_points; ++i) {
    const double t = double(i) / outline_points;
    mesh.positions.emplace_back(outer(t));
    mesh.positions.emplace_back(inner(t));
  }
  for (std::uint32_t i = 0; i < outline_points; ++i) {
    const std::uint32_t here = first + 2 * i, next = first + 2 * ((i + 1) % outline_points);
    mesh.triangles.push_back({here, next, next + 1});
    mesh.triangles.push_back({here, next + 1, here + 1});
  }
}

/// A cell of the polar grid, or a rounded shape in it.
struct Cell {
  double r0, r1, phi0, phi1;

  Vec at(double x, double y) const {  // x along the radius, y along the angle, in [-1, 1]
    const double r = 0.5 * (r0 + r1) + 0.5 * (r1 - r0) * x;
    const double phi = 0.5 * (phi0 + phi1) + 0.5 * (phi1 - phi0) * y;
    return {r * std::cos(phi), r * std::sin(phi), 0};
  }

  /// Its border: the square's, reached in the direction of angle t.
  Outline border() const {
    return [cell = *this](double t) {
      const double c = std::cos(2 * pi * t), s = std::sin(2 * pi * t);
      const double scale = 1 / std::max(std::abs(c), std::abs(s));
      return cell.at(c * scale, s * scale);
    };
  }

  /// |x|^n + |y|^n = 1 shrunk: a circle for n = 2, nearly the border for large n.
  Outline rounded(double n, double shrink_x, double shrink_y) const {
    return [cell = *this, n, shrink_x, shrink_y](double t) {
      const double c = std::cos(2 * pi * t), s = std::sin(2 * pi * t);
      const double scale = std::pow(std::pow(std::abs(c), n) + std::pow(std::abs(s), n), -1 / n);
      return cell.at(c * scale * shrink_x, s * scale * shrink_y);
    };
  }

  Outline middle() const {
    return [cell = *this](double) { return cell.at(0, 0); };
  }
};

Outline circle(double radius) {
  return [radius](double t) {
    return Vec{radius * std::cos(2 * pi * t), radius * std::sin(2 * pi * t), 0};
  };
}

struct Glass {
  const char* name;
  Rgb<double> tint;
};

constexpr Glass glasses[] = {{"blue", {0.04, 0.12, 0.85}},
                             {"red", {0.85, 0.04, 0.05}},
                             {"amber", {1.0, 0.58, 0.08}},
                             {"green", {0.06, 0.6, 0.16}},
                             {"violet", {0.45, 0.08, 0.7}}};
constexpr std::size_t blue = 0, red = 1, amber = 2, green = 3, violet = 4;

/// The window as it grows: stone, and one mesh for each glass.
struct Work {
  Mesh stone;
  Mesh panes[std::size(glasses)];
  double half;  ///< of the thickness

  /// Fills a cell: stone outside, a rim of one glass, a heart of another.
  void fill(const Cell& cell, double roundness, double shrink_x, double shrink_y, std::size_t rim,
            std::size_t heart) {
    const Outline edge = cell.rounded(roundness, shrink_x, shrink_y);
    const Outline inner = cell.rounded(2, 0.6 * shrink_x, 0.6 * shrink_y);
    add_frame(stone, cell.border(), edge, half);
    add_pane(panes[rim], edge, inner);
    add_pane(panes[heart], inner, cell.middle());
  }
};

}  // namespace

Parts RoseWindowObject::build(const Cursor& at) const {
  if (wall_width < 2 * radius || wall_below < radius || wall_height - wall_below < radius)
    at.complain("does not fit into its wall: the round opening must lie inside");
  const double eye = 0.16 * radius, inner = 0.58 * radius;
  const double width = 2 * pi * radius / double(2 * petals);  // of a cell of the outer ring
  const double narrow = 1 - bar / width;
  const auto across = [&](double length) { return 1 - bar / length; };
  if (narrow <= 0 || across(radius - inner) <= 0 || bar >= eye)
    at.complain("has no panes left: the bars are too wide");

  Work work;
  work.half = thickness / 2;
  const Outline none = [](double) { return Vec{}; };
  const Outline medallion = circle(eye - 0.5 * bar);
  add_frame(work.stone, circle(eye), medallion, work.half);
  add_pane(work.panes[amber], medallion, circle(0.5 * eye));
  add_pane(work.panes[red], circle(0.5 * eye), none);

  const double step = 2 * pi / double(petals);
  for (std::int64_t i = 0; i < petals; ++i) {
    const double phi = step * double(i);
    const Cell petal{eye, inner, phi - step / 2, phi + step / 2};
    work.fill(petal, 3, across(inner - eye), narrow, i % 2 ? blue : violet, i % 2 ? red : amber);
    for (const int side : {-1, 1}) {
      const Cell pane{inner, radius, side < 0 ? phi - step / 2 : phi,
                      side < 0 ? phi : phi + step / 2};
      work.fill(pane, 2.4, across(radius - inner), narrow, (i + (side > 0)) % 2 ? blue : green,
                side > 0 ? amber : red);
    }
  }
  const Outline wall = [&](double t) {  // the square's border, stretched: corners stay corners
    const double c = std::cos(2 * pi * t), s = std::sin(2 * pi * t);
    const double scale = 1 / std::max(std::abs(c), std::abs(s));
    return Vec{c * scale * 0.5 * wall_width,
               s * scale * (s < 0 ? wall_below : wall_height - wall_below), 0};
  };
  add_frame(work.stone, wall, circle(radius), work.half);

  Parts parts;
  parts.objects.push_back({"stone", std::move(work.stone), {.albedo = albedo}});
  for (std::size_t i = 0; i < std::size(glasses); ++i)
    parts.objects.push_back(
        {glasses[i].name, std::move(work.panes[i]), {.opacity = 0, .tint = glasses[i].tint}});
  return parts;
}

}  // namespace airlight
