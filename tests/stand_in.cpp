// What a model without a scene file stands for: a camera, a sun and fog.

#include "scene/stand_in.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "image/atomic_file.h"
#include "scene/bounds.h"
#include "scene/load_scene.h"
#include "scene/look_around.h"
#include "scene/objects/build.h"
#include "support/folder.h"

namespace airlight {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Object object(Mesh mesh) { return {"part", std::move(mesh), {}}; }

Model cube() {
  Mesh mesh;
  add_box(mesh, {0, 0, 0}, {2, 2, 2});
  Model model;
  model.objects.push_back(object(std::move(mesh)));
  return model;
}

/// A room of 6 m x 3 m x 4 m between thick walls, open to +x above a parapet.
Model room() {
  Mesh mesh;
  add_box(mesh, {-1, -1, -1}, {7, 0, 5});
  add_box(mesh, {-1, 3, -1}, {7, 4, 5});
  add_box(mesh, {-1, 0, -1}, {0, 3, 5});
  add_box(mesh, {0, 0, -1}, {7, 3, 0});
  add_box(mesh, {0, 0, 4}, {7, 3, 5});
  add_box(mesh, {6, 0, 0}, {6.2, 1, 4});
  Model model;
  model.objects.push_back(object(std::move(mesh)));
  return model;
}

/// A room of 8 m x 5 m x 6 m without windows but for an opening of 2 m x 2 m in its roof.
Model room_with_skylight() {
  Mesh mesh;
  add_box(mesh, {-1, -1, -1}, {9, 0, 7});
  add_box(mesh, {-1, 0, -1}, {0, 6, 7});
  add_box(mesh, {8, 0, -1}, {9, 6, 7});
  add_box(mesh, {0, 0, -1}, {8, 6, 0});
  add_box(mesh, {0, 0, 6}, {8, 6, 7});
  add_box(mesh, {0, 5, 0}, {5, 5.2, 6});
  add_box(mesh, {7, 5, 0}, {8, 5.2, 6});
  add_box(mesh, {5, 5, 0}, {7, 5.2, 2});
  add_box(mesh, {5, 5, 4}, {7, 5.2, 6});
  Model model;
  model.objects.push_back(object(std::move(mesh)));
  return model;
}

/// A closed room of 6 m x 3 m x 4 m, whose walls at the ends show their backs.
Model room_with_turned_walls() {
  Mesh mesh;
  add_box(mesh, {0, 0, 0}, {6, 3, 4});
  for (auto& [a, b, c] : mesh.triangles) {
    const auto x = [&](std::uint32_t i) { return mesh.positions[i].x; };
    const bool at_an_end = x(a) == x(b) && x(b) == x(c);
    if (!at_an_end) std::swap(b, c);
  }
  Model model;
  model.objects.push_back(object(std::move(mesh)));
  return model;
}

/// Ground of 80 m by 80 m in waves around its middle, which lies 8 m above a hollow and 8 m below
/// the ridge about it.
Model terrain() {
  constexpr int n = 81;
  Mesh mesh;
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x) {
      const double y = -8 * std::cos(pi / 12 * std::hypot(x - 40, z - 40));
      mesh.positions.emplace_back(float(x), float(y), float(z));
    }
  for (std::uint32_t z = 0; z + 1 < n; ++z)
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const std::uint32_t at = z * n + x;
      mesh.triangles.push_back({at, at + n, at + 1});
      mesh.triangles.push_back({at + 1, at + n, at + n + 1});
    }
  Model model;
  model.objects.push_back(object(std::move(mesh)));
  return model;
}

/// What a stand-in's scene file means, the model itself left out.
Scene scene_of(const StandIn& stand_in, const Model& model) {
  const std::string toml = stand_in.toml(model);
  return parse_scene(toml.substr(0, toml.find("[[objects]]")), "model");
}

}  // namespace

TEST(LookAround, tells_inside_from_outside) {
  const auto middle = look_around(room().objects, {{3, 1.5, 2}})[0];
  EXPECT_GT(middle.enclosed(), 0.8);
  EXPECT_EQ(middle.inside_out(), 0);
  const auto solid = look_around(cube().objects, {{1, 1, 1}})[0];
  EXPECT_EQ(solid.inside_out(), 1);
}

TEST(LookAround, measures_distances) {
  const auto seen = look_around(cube().objects, {{1, 1, 1}})[0];
  for (std::size_t i = 0; i < Panorama::directions; ++i) {
    const Vec3<double> d = Panorama::direction(i);
    const double farthest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    EXPECT_NEAR(seen.distance[i] * farthest, 1, 1e-5);
  }
}

TEST(LookAround, finds_the_sky_where_nothing_opaque_is_in_the_way) {
  Model model = room_with_skylight();
  const Vec3<double> up{0, 1, 0};
  const std::vector<Sight> sights{{{6, 1, 3}, up}, {{3, 1, 3}, up}, {{6, 9, 3}, -up}};
  EXPECT_EQ(see_the_sky(model.objects, sights), (std::vector<std::uint8_t>{1, 0, 0}));
  model.objects.push_back({"ball", Sphere{{6, 3, 3}, 0.5}, {}});
  EXPECT_EQ(see_the_sky(model.objects, {sights[0]})[0], 0);
  EXPECT_EQ(see_the_sky(model.objects, {{{6, 4, 3}, up}})[0], 1);
  model.objects.back().material.opacity = 0.5;
  EXPECT_EQ(see_the_sky(model.objects, {sights[0]})[0], 1);
}

TEST(StandIn, takes_a_room_s_own_camera_where_no_place_looks_like_inside) {
  Model model = room_with_turned_walls();
  const auto middle = look_around(model.objects, {{3, 1.5, 2}})[0];
  EXPECT_GT(middle.enclosed(), 0.7);    // a room, yet
  EXPECT_GT(middle.inside_out(), 0.1);  // not inside of it, as is true of all places there
  model.camera = Camera{.position = {5, 1.5, 2}, .target = {0, 1.5, 2}, .up = {0, 1, 0}};
  const Scene scene = scene_of(StandIn(model, "room.glb"), model);
  EXPECT_EQ(scene.camera.position.x, 5);
  const Box& fog = std::get<Box>(scene.media[0].shape);
  EXPECT_NEAR(fog.max.x - fog.min.x, 6, 1);
}

TEST(StandIn, sees_a_thing_from_outside) {
  const StandIn stand_in(cube(), "cube.obj");
  EXPECT_THAT(stand_in.remark({}), HasSubstr("a camera outside at "));
  const Scene scene = scene_of(stand_in, cube());
  EXPECT_GT(length(scene.camera.position - Vec3<double>{1, 1, 1}), 3);
  const Box& fog = std::get<Box>(scene.media[0].shape);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(fog.min[k], 0);
    EXPECT_GT(fog.max[k], 2);
  }
}

TEST(LookAround, measures_the_light_of_the_sky) {
  const std::vector<Object> nothing, roofed = room().objects;
  EXPECT_EQ(light_of_the_sky(nothing, {0, 0, 0}), 1);
  EXPECT_LT(light_of_the_sky(roofed, {3, 1.5, 2}), 0.1);
  // A ball of radius 1 takes sin² of its own angle, (1 / 2)², from a place 2 m below its centre.
  const std::vector<Object> ball = {{"ball", Sphere{{0, 2, 0}, 1}, {}}};
  EXPECT_NEAR(light_of_the_sky(ball, {0, 0, 0}), 0.75, 0.02);
}

TEST(StandIn, sees_a_terrain_from_outside_whatever_its_valleys_hide) {
  const Model model = terrain();
  const auto middle = look_around(model.objects, {bounds_of(model.objects).centre()})[0];
  EXPECT_GT(middle.enclosed(), 0.7);
  EXPECT_THAT(StandIn(model, "terrain.obj").remark({}), HasSubstr("a camera outside at "));
}

TEST(StandIn, sees_a_room_with_a_skylight_from_inside) {
  EXPECT_THAT(StandIn(room_with_skylight(), "room.obj").remark({}),
              HasSubstr("a camera in the room at "));
}

TEST(StandIn, sees_a_room_from_inside_with_the_sun_in_its_window) {
  const StandIn stand_in(room(), "room.obj");
  EXPECT_THAT(stand_in.remark({}), HasSubstr("a camera in the room at "));
  const Scene scene = scene_of(stand_in, room());
  const Vec3<double> eye = scene.camera.position;
  EXPECT_TRUE(eye.x > 0 && eye.x < 6 && eye.y > 0 && eye.y < 3 && eye.z > 0 && eye.z < 4);
  const Vec3<double> light = std::get<Directional>(scene.lights.at(0)).direction;
  EXPECT_LT(light.x, -0.5) << "the window is open to +x";
  EXPECT_LT(light.y, -0.2);
}

/// The part of the points in the camera's view, spread over the fog, that the sun reaches.
double lit_part(const Model& model, const Scene& scene) {
  const Box& fog = std::get<Box>(scene.media[0].shape);
  const Vec3<double> sun = std::get<Directional>(scene.lights.at(0)).toward();
  const Vec3<double> view = normalize(scene.camera.target - scene.camera.position);
  std::vector<Sight> sights;
  for (int i = 0; i < 1000; ++i) {
    const Vec3<double> part{(i % 10 + 0.5) / 10, (i / 10 % 10 + 0.5) / 10, (i / 100 + 0.5) / 10};
    const Vec3<double> size = fog.max - fog.min;
    const Vec3<double> p =
        fog.min + Vec3<double>{size.x * part.x, size.y * part.y, size.z * part.z};
    if (dot(normalize(p - scene.camera.position), view) > 0.8) sights.push_back({p, sun});
  }
  double lit = 0;
  for (const std::uint8_t sees : see_the_sky(model.objects, sights)) lit += sees;
  return lit / double(sights.size());
}

TEST(StandIn, shows_shafts_of_light_in_a_room_with_one_small_window) {
  const Model model = room_with_skylight();
  const Scene scene = scene_of(StandIn(model, "room.obj"), model);
  EXPECT_GT(lit_part(model, scene), 0.03);
  EXPECT_LT(lit_part(model, scene), 0.7);
}

TEST(StandIn, turns_a_model_s_camera_s_sun_and_a_model_s_sun_s_camera_to_the_shafts) {
  Model with_camera = room();
  with_camera.camera = Camera{{1, 1.5, 3.8}, {3, 1.5, 2}, {0, 1, 0}, 50};
  EXPECT_GT(lit_part(with_camera, scene_of(StandIn(with_camera, "room.obj"), with_camera)), 0.03);
  Model with_sun = room();
  with_sun.lights.push_back(Directional{{1, 2, 3}, normalize(Vec3<double>{-1, -0.5, 0.2}), 0.5});
  EXPECT_GT(lit_part(with_sun, scene_of(StandIn(with_sun, "room.obj"), with_sun)), 0.03);
}

TEST(StandIn, keeps_the_camera_and_the_lights_of_a_model) {
  Model model = cube();
  model.camera = Camera{{5, 6, 7}, {0, 1, 0}, {0, 1, 0}, 33};
  model.lights.push_back(Directional{{1, 2, 3}, {0, 0.6, -0.8}, 0.5});
  const StandIn stand_in(model, "cube.obj");
  EXPECT_THAT(stand_in.remark({}), StartsWith("assumed: fog from "));
  const Scene scene = scene_of(stand_in, model);
  EXPECT_EQ(scene.camera.position, Vec3<double>(5, 6, 7));
  EXPECT_EQ(scene.camera.fov, 33);
  const auto& light = std::get<Directional>(scene.lights.at(0));
  EXPECT_EQ(light.irradiance, Rgb<double>(1, 2, 3));
  EXPECT_NEAR(light.direction.z, -0.8, 1e-15);
  EXPECT_EQ(light.angular_diameter, 0.5);
}

TEST(StandIn, makes_a_scene_of_a_model_file) {
  const test::Folder scratch;
  const std::filesystem::path file = scratch / R"(a '''b"c.obj)";
  write_text(file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = load_scene(file, {"render.spp=3", "lights.0.azimuth=10", "camera.fov=20"});
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_FALSE(scene.media.empty());
  EXPECT_EQ(scene.render.spp, 3);
  EXPECT_EQ(scene.camera.fov, 20);
  EXPECT_THAT(scene.assumptions, Contains(StartsWith("assumed: a camera outside at ")));
}

TEST(StandIn, tells_only_what_was_not_changed) {
  const StandIn stand_in(cube(), "cube.obj");
  EXPECT_THAT(stand_in.remark({}), AllOf(HasSubstr("a camera outside at"), HasSubstr("azimuth 70"),
                                         HasSubstr("elevation 40"), HasSubstr("fog from"),
                                         HasSubstr("light of the sky")));
  EXPECT_THAT(stand_in.remark({"camera.position=[9, 9, 9]", "lights.0.azimuth=10"}),
              StartsWith("assumed: a sun at elevation 40, fog from"));
  EXPECT_THAT(stand_in.remark({"lights.0.direction=[0, -1, 0]"}), Not(HasSubstr("a sun")));
  EXPECT_THAT(stand_in.remark({"media.0.shape.max=[9, 9, 9]"}), Not(HasSubstr("fog")));
  EXPECT_THAT(stand_in.remark({"media.0.sigma_t=1"}), HasSubstr("fog from"));
  EXPECT_EQ(stand_in.remark({"camera={}", "lights=[]", "media=[]", "background=0"}), "");
}

}  // namespace airlight
