// What the objects of a scene file are made of.

#include "scene/objects.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "error.h"
#include "scene/bounds.h"
#include "scene/described.h"
#include "scene/load_scene.h"
#include "scene/look_around.h"

namespace airlight {
namespace {

using ::testing::HasSubstr;

/// The objects of a scene file with one object of these keys.
std::vector<Object> objects_of(const std::string& keys) {
  return parse_scene("[[objects]]\n" + keys, "fog.toml").objects;
}

Bounds bounds(const std::string& keys) { return bounds_of(objects_of(keys)); }

void expect_near(const Vec3<double>& a, const Vec3<double>& b) {
  EXPECT_LT(length(a - b), 1e-5) << a.x << ", " << a.y << ", " << a.z;  // positions are floats
}

std::string error_of(const std::string& keys) {
  try {
    objects_of(keys);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [i, j, k] : mesh.triangles)
    area += 0.5 * length(Vec3<double>(cross(mesh.positions[j] - mesh.positions[i],
                                            mesh.positions[k] - mesh.positions[i])));
  return area;
}

const Mesh& mesh_of(const std::vector<Object>& objects, std::size_t i = 0) {
  return std::get<Mesh>(objects.at(i).geometry);
}

/// Whether every edge of two triangles is run through once in each direction: a closed skin.
bool is_closed(const Mesh& mesh) {
  using Point = std::tuple<float, float, float>;
  const auto point = [&](std::uint32_t i) {
    const auto& p = mesh.positions[i];
    return Point{p.x, p.y, p.z};
  };
  std::map<std::pair<Point, Point>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = point(t[k]), b = point(t[(k + 1) % 3]);
      ++edges[{a, b}];
      --edges[{b, a}];
    }
  return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

TEST(Objects, of_every_kind_can_be_made_with_their_defaults) {
  for_each_member<Objects>([](const auto& kind) {
    std::string keys = "type = \"" + std::string(kind.name) + "\"\n";
    if constexpr (requires { kind.file; }) return;  // needs a file
    if (keys.find("\"boxes\"") != std::string::npos) keys += "boxes = [[0, 0, 0, 1, 1, 1]]\n";
    const std::vector<Object> objects = objects_of(keys);
    EXPECT_FALSE(objects.empty()) << kind.name;
    std::set<std::string> names;
    for (const Object& object : objects) {
      EXPECT_TRUE(names.insert(object.name).second) << object.name;
      if (const auto* mesh = std::get_if<Mesh>(&object.geometry)) {
        EXPECT_FALSE(mesh->triangles.empty()) << object.name;
        for (const auto& triangle : mesh->triangles)
          for (const std::uint32_t i : triangle) ASSERT_LT(i, mesh->positions.size());
        EXPECT_TRUE(mesh->uvs.empty() || mesh->uvs.size() == mesh->positions.size());
      }
    }
  });
}

TEST(Objects, are_scaled_turned_and_moved_in_this_order) {
  const auto objects = objects_of(
      "type = \"sphere\"\ncentre = [1, 0, 0]\nradius = 0.5\nscale = 2\nrotate = [0, 90, 0]\n"
      "translate = [0, 0, 10]\n");
  const Sphere& sphere = std::get<Sphere>(objects.at(0).geometry);
  expect_near(sphere.centre, {0, 0, 8});  // (1, 0, 0) becomes (2, 0, 0), then (0, 0, -2)
  EXPECT_EQ(sphere.radius, 1);
}

TEST(Objects, carry_their_surface) {
  const auto objects = objects_of(
      "type = \"disc\"\nname = \"pane\"\nalbedo = [0.1, 0.2, 0.3]\nopacity = 0.25\ncutoff = 0.5\n"
      "tint = [1, 0, 0]\n");
  const Object& pane = objects.at(0);
  EXPECT_EQ(pane.name, "pane");
  EXPECT_EQ(pane.material.albedo, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_EQ(pane.material.opacity, 0.25);
  EXPECT_EQ(pane.material.cutoff, 0.5);
  EXPECT_EQ(pane.material.tint, Rgb<double>(1, 0, 0));
}

TEST(Objects, complain_about_textures_at_their_key) {
  EXPECT_THAT(error_of("type = \"disc\"\nalbedo_texture = \"none.png\"\n"),
              HasSubstr("fog.toml:3:18: objects.0.albedo_texture names a picture that is not to be "
                        "had: none.png: cannot be read: No such file or directory"));
}

TEST(Objects, refuse_shapes_without_extent) {
  EXPECT_THAT(error_of("type = \"box\"\nmax = [1, -1, 1]\n"), HasSubstr("is an empty box"));
  EXPECT_THAT(error_of("type = \"rectangle\"\nu = [1, 1, 0]\nv = [-2, -2, 0]\n"),
              HasSubstr("objects.0 has no area"));
  EXPECT_THAT(error_of("type = \"sphere\"\nradius = 0\n"), HasSubstr("a number above 0 m"));
  EXPECT_THAT(error_of("type = \"disc\"\nnormal = [0, 0, 0]\n"), HasSubstr("is no direction"));
  EXPECT_THAT(error_of("type = \"boxes\"\nboxes = []\n"), HasSubstr("at least one box"));
  EXPECT_THAT(error_of("type = \"boxes\"\nboxes = [[0, 0, 0, 1, 1, 0]]\n"),
              HasSubstr("objects.0.boxes.0 = [0, 0, 0, 1, 1, 0] is empty or inverted"));
  EXPECT_THAT(error_of("type = \"wall\"\nwindow_max = [5, 2]\n"), HasSubstr("window_max must not"));
  EXPECT_THAT(error_of("type = \"wall\"\nbar_width = 1\ncolumns = 3\n"),
              HasSubstr("no openings left"));
  EXPECT_THAT(error_of("type = \"rose_window\"\nradius = 4\n"), HasSubstr("does not fit"));
  EXPECT_THAT(error_of("type = \"rose_window\"\nbar = 0.9\n"), HasSubstr("no panes left"));
}

TEST(Box, turns_about_its_centre) {
  const std::string box = "type = \"box\"\nmin = [1, 1, 1]\nmax = [3, 2, 2]\n";
  EXPECT_TRUE(is_closed(mesh_of(objects_of(box))));
  EXPECT_NEAR(area_of(mesh_of(objects_of(box))), 2 * (2 + 2 + 1), 1e-5);
  const Bounds turned = bounds(box + "rotation = [0, 90, 0]\n");
  expect_near(turned.min, {1.5, 1, 0.5});
  expect_near(turned.max, {2.5, 2, 2.5});
}

TEST(Box, shows_its_front_outside) {
  const auto seen = look_around(objects_of("type = \"box\"\n"), {{0, 0, 0}})[0];
  EXPECT_EQ(seen.enclosed(), 0);
  EXPECT_EQ(seen.inside_out(), 1);
}

TEST(Bounds, lie_around_all_surfaces) {
  EXPECT_TRUE(bounds_of({}).empty());
  Mesh mesh;
  for (const auto& p : {Vec3<float>(9, 9, 9), {0, 3, 0}, {1, 4, 0}, {-1, 3, 1}})
    mesh.positions.push_back(p);
  mesh.triangles = {{1, 2, 3}};  // the first vertex is in none
  const Bounds all = bounds_of({{"", mesh, {}}, {"", Sphere{{5, 0, -1}, 2}, {}}});
  EXPECT_FALSE(all.empty());
  EXPECT_EQ(all.min, Vec3<double>(-1, -2, -3));
  EXPECT_EQ(all.max, Vec3<double>(7, 4, 1));
}

TEST(Wall, has_as_many_openings_as_asked) {
  const auto objects = objects_of(
      "type = \"wall\"\nwidth = 4\nheight = 3\nthickness = 0.2\nwindow_min = [1, 1]\n"
      "window_max = [3, 2]\ncolumns = 4\nrows = 2\nbar_width = 0.1\nbar_depth = 0.1\n");
  const Bounds all = bounds_of(objects);
  expect_near(all.min, {0, 0, -0.1});
  expect_near(all.max, {4, 3, 0.1});
  // Light along z passes where no box stands: the window less 3 bars across its height and 1 along
  // its width, which the others cross 3 times. Each box shows its front to +z once.
  double shade = 0;
  const Mesh& mesh = mesh_of(objects);
  for (const auto& [i, j, k] : mesh.triangles) {
    const auto n =
        cross(mesh.positions[j] - mesh.positions[i], mesh.positions[k] - mesh.positions[i]);
    shade += 0.5 * std::max(0.0F, n.z);
  }
  EXPECT_NEAR(4 * 3 - shade, 2 * 1 - 3 * 0.1 - 2 * 0.1 + 3 * 0.1 * 0.1, 1e-5);
}

TEST(Blinds, let_level_light_through_by_their_tilt) {
  for (const double tilt : {0.0, 30.0, -45.0}) {
    const auto objects = objects_of(
        "type = \"blinds\"\nwidth = 2\nheight = 3\nslats = 10\nslat_width = 0.1\ntilt = " +
        std::to_string(tilt) + "\n");
    const Mesh& mesh = mesh_of(objects);
    EXPECT_EQ(mesh.triangles.size(), 20U);
    EXPECT_NEAR(area_of(mesh), 10 * 2 * 0.1, 1e-5);
    const float rise = mesh.positions[1].y - mesh.positions[0].y;
    EXPECT_NEAR(rise, 0.1 * std::sin(tilt * pi / 180), 1e-6);
  }
}

TEST(RoseWindow, tiles_its_disc_with_stone_and_glass) {
  const auto objects =
      objects_of("type = \"rose_window\"\nwall_width = 8\nwall_height = 7\nwall_below = 4\n");
  ASSERT_EQ(objects.size(), 6U);
  const Mesh& stone = mesh_of(objects);
  double front = 0, glass = 0;
  for (const auto& [i, j, k] : stone.triangles) {
    const auto n =
        cross(stone.positions[j] - stone.positions[i], stone.positions[k] - stone.positions[i]);
    front += 0.5 * std::max(0.0F, n.z);
  }
  for (std::size_t i = 1; i < objects.size(); ++i) {
    EXPECT_EQ(objects[i].material.opacity, 0) << objects[i].name;
    glass += area_of(mesh_of(objects, i));
  }
  // Curves are polygons of 48 corners: the area is right to a fraction of that.
  EXPECT_NEAR(front + glass, 8 * 7, 0.05);
  EXPECT_GT(glass, 0.35 * pi * 2 * 2);
}

TEST(Tree, stands_at_its_origin_and_differs_by_seed) {
  const auto one = objects_of("type = \"tree\"\n");
  ASSERT_EQ(one.size(), 2U);
  const Bounds all = bounds_of(one);
  EXPECT_NEAR(all.min.y, 0, 0.05);
  EXPECT_NEAR(all.max.y, 8, 1);
  EXPECT_GE(one[1].material.opacity_texture, 0);
  EXPECT_TRUE(one[1].material.opacity_from_alpha);
  EXPECT_EQ(mesh_of(one, 1).triangles.size(), 8000U);
  const auto same = objects_of("type = \"tree\"\n"),
             other = objects_of("type = \"tree\"\nseed = 1\n");
  EXPECT_EQ(mesh_of(one, 1).positions[5], mesh_of(same, 1).positions[5]);
  EXPECT_FALSE(mesh_of(one, 1).positions[5] == mesh_of(other, 1).positions[5]);
}

TEST(Tree, has_leaves_with_holes) {
  const Scene scene = parse_scene("[[objects]]\ntype = \"tree\"\n", "fog.toml");
  const Texture& leaf = scene.textures.at(0);
  double opaque = 0;
  for (std::size_t i = 3; i < leaf.rgba.size(); i += 4) opaque += leaf.rgba[i] == 255;
  opaque /= leaf.width * leaf.height;
  EXPECT_GT(opaque, 0.15);
  EXPECT_LT(opaque, 0.6);
}

namespace {

/// A shattered wall at a time: 3 m x 2 m x 0.2 m, broken about its middle.
Mesh shattered(const std::string& time, const std::string& more = "") {
  return mesh_of(
      objects_of("type = \"shattered_wall\"\nwidth = 3\nheight = 2\nthickness = 0.2\n"
                 "impact = [1.5, 1]\nradius = 0.8\npieces = 150\ntime = " +
                 time + "\n" + more));
}

/// By the divergence theorem, for a closed skin that faces out.
double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [i, j, k] : mesh.triangles)
    volume += dot(Vec3<double>(mesh.positions[i]),
                  cross(Vec3<double>(mesh.positions[j]), Vec3<double>(mesh.positions[k]))) /
              6;
  return volume;
}

}  // namespace

TEST(ShatteredWall, stands_whole_until_the_blow) {
  const Mesh before = shattered("-3"), at_blow = shattered("0");
  EXPECT_EQ(before.positions, at_blow.positions);
  const Bounds box = bounds_of({{"", before, {}}});
  expect_near(box.min, {0, 0, -0.1});
  expect_near(box.max, {3, 2, 0.1});
}

TEST(ShatteredWall, consists_of_closed_pieces_that_fill_it_and_keep_their_volume) {
  for (const char* time : {"0", "0.1", "0.4", "5"}) {
    const Mesh mesh = shattered(time);
    EXPECT_TRUE(is_closed(mesh)) << time;
    EXPECT_NEAR(volume_of(mesh), 3 * 2 * 0.2, 1e-5) << time;  // positions are floats
  }
}

TEST(ShatteredWall, throws_pieces_forward_onto_the_floor_where_they_come_to_rest) {
  const Mesh start = shattered("0"), soon = shattered("0.15"), late = shattered("20");
  EXPECT_EQ(late.positions, shattered("30").positions);
  int loose = 0;
  for (std::size_t i = 0; i < start.positions.size(); ++i) {
    const Vec3<double> from(start.positions[i]), to(late.positions[i]);
    EXPECT_GT(late.positions[i].y, -1e-6);
    EXPECT_GT(soon.positions[i].y, -1e-6);
    if (length(to - from) == 0) continue;
    ++loose;
    EXPECT_GT(to.z, 0.1);
    EXPECT_LT(to.y, 0.6) << "not at rest near the floor";
    EXPECT_LT(length(from - Vec3<double>(1.5, 1, 0)), 1.5) << "far from the blow";
  }
  EXPECT_GT(loose, 300);
}

TEST(ShatteredWall, moves_without_jumps) {
  // Thrown with less than 7 m/s, falling with less than 7, corners turning with less than 11.
  Mesh before = shattered("0.0");
  for (int i = 1; i <= 60; ++i) {
    const Mesh now = shattered(std::to_string(i * 0.02));
    double farthest = 0;
    for (std::size_t k = 0; k < now.positions.size(); ++k)
      farthest = std::max(farthest, length(Vec3<double>(now.positions[k] - before.positions[k])));
    EXPECT_LT(farthest, 0.02 * 25) << i;
    before = now;
  }
}

TEST(ShatteredWall, breaks_otherwise_for_another_seed) {
  EXPECT_EQ(shattered("0.3").positions, shattered("0.3").positions);
  EXPECT_NE(shattered("0.3").positions, shattered("0.3", "seed = 1\n").positions);
}

}  // namespace airlight
