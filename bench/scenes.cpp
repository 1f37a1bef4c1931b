#include "scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "scene/load_scene.h"

namespace airlight::bench {
namespace {

/// A grid of quads over a parametric surface, s and t in [0, 1].
template <class Surface>
void add_sheet(Scene& scene, const char* name, int columns, int rows, Surface&& point) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      mesh.positions.push_back(Vec3<float>(point(double(i) / columns, double(j) / rows)));
  const auto index = [&](int i, int j) { return std::uint32_t(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  scene.objects.push_back({name, std::move(mesh), {}});
}

void add_rectangle(Scene& scene, const char* name, Vec3<double> corner, Vec3<double> a,
                   Vec3<double> b) {
  add_sheet(scene, name, 1, 1, [&](double s, double t) { return corner + a * s + b * t; });
}

void add_cup(Scene& scene, Vec3<double> foot, double radius) {
  add_sheet(scene, "cup", 48, 24, [&](double s, double t) {
    const double angle = 2 * pi * s, r = radius * (0.6 + 0.4 * std::sin(t * 2.2));
    return foot + Vec3<double>(r * std::cos(angle), 2.2 * radius * t, r * std::sin(angle));
  });
}

}  // namespace

Scene sunroom() { return load_scene(AIRLIGHT_SOURCE_DIR "/scenes/sunroom.toml", {}); }

Scene sphere_in_fog() {
  Scene scene = load_scene(AIRLIGHT_SOURCE_DIR "/scenes/sphere_in_fog.toml", {});
  scene.render.visibility = Visibility::embree;
  return scene;
}

Scene crowded_room() {
  Scene scene;
  using V = Vec3<double>;
  add_rectangle(scene, "floor", {-4, 0, -4}, {8, 0, 0}, {0, 0, 8});
  add_rectangle(scene, "ceiling", {-4, 3, -4}, {8, 0, 0}, {0, 0, 8});
  add_rectangle(scene, "back wall", {-4, 0, -4}, {8, 0, 0}, {0, 3, 0});
  add_rectangle(scene, "left wall", {-4, 0, -4}, {0, 0, 8}, {0, 3, 0});
  for (int i = 0; i <= 4; ++i)  // the right wall is piers between four windows
    add_rectangle(scene, "pier", {4, 0, -4 + 1.9 * i}, {0, 0, i == 4 ? 0.4 : 0.7}, {0, 3, 0});
  for (int i = 0; i < 4; ++i) {
    const double z = -3.3 + 1.9 * i;
    add_rectangle(scene, "sill", {4, 0, z}, {0, 0, 1.2}, {0, 0.8, 0});
    for (int bar = 1; bar < 4; ++bar)
      add_rectangle(scene, "bar", {4, 0.8, z + 0.3 * bar - 0.02}, {0, 0, 0.04}, {0, 2, 0});
    add_sheet(scene, "curtain", 160, 100, [&](double s, double t) {
      return V(3.85 + 0.05 * std::sin(40 * s + std::sin(5 * t)), 0.1 + 2.8 * t, z - 0.25 + 0.4 * s);
    });
  }
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 2; ++j) {
      const V table(-2.8 + 1.3 * i, 0.75, -2.2 + 2.4 * j);
      add_sheet(scene, "table cloth", 60, 60, [&](double s, double t) {
        return table + V(s - 0.5, 0.01 * std::sin(9 * s) * std::cos(8 * t), t - 0.5);
      });
      for (int leg = 0; leg < 4; ++leg)
        add_sheet(scene, "leg", 16, 4, [&](double s, double t) {
          return table + V(leg % 2 ? 0.4 : -0.4, -0.75 * t, leg / 2 ? 0.4 : -0.4) +
                 V(0.03 * std::cos(2 * pi * s), 0, 0.03 * std::sin(2 * pi * s));
        });
      for (int cup = 0; cup < 3; ++cup)
        add_cup(scene, table + V(-0.3 + 0.3 * cup, 0.02, 0.2 * std::cos(cup + i)), 0.05);
    }
  scene.camera = {
      .position = {-3.6, 1.7, 3.8}, .target = {1, 1.1, -1.5}, .up = {0, 1, 0}, .fov = 55};
  scene.media.push_back(Medium{.sigma_s = Rgb<double>(0.09),
                               .sigma_t = Rgb<double>(0.1),
                               .emission = {},
                               .phase = HenyeyGreenstein{0.5},
                               .shape = Box{{-4, 0, -4}, {4, 3, 4}, {0, 0, 0}}});
  scene.lights = {Directional{Rgb<double>(10.), normalize(V(-0.8, -0.45, -0.3)), 0}};
  return scene;
}

std::string as_obj(const Scene& scene) {
  std::string text;
  auto out = std::back_inserter(text);
  std::size_t base = 1;
  for (const Object& object : scene.objects) {
    const auto* mesh = std::get_if<Mesh>(&object.geometry);
    if (!mesh) continue;
    fmt::format_to(out, "o {}\n", object.name);
    for (const auto& p : mesh->positions) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
    for (const auto& p : mesh->positions) fmt::format_to(out, "vt {} {}\n", p.x, p.z);
    for (const auto& t : mesh->triangles)
      fmt::format_to(out, "f {0}/{0} {1}/{1} {2}/{2}\n", base + t[0], base + t[1], base + t[2]);
    base += mesh->positions.size();
  }
  return text;
}

}  // namespace airlight::bench
