// Values that change from frame to frame, models that move, and runs of frames.

#include "scene/animation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "error.h"
#include "image/input.h"
#include "image/numbered.h"
#include "render/render.h"
#include "scene/load_scene.h"
#include "scene/models/model.h"
#include "support/gltf_builder.h"
#include "support/refused.h"
#include "support/scene_desk.h"

namespace airlight {
namespace {

using test::bytes_of, test::Folder, test::Outcome, test::run, test::write_bytes;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The scene of a frame of "film.toml".
Scene scene_at(const std::string& text, std::int64_t frame, std::vector<Override> overrides = {}) {
  overrides.emplace_back("render.frame", std::to_string(frame), "frame");
  return parse_scene(text, "film.toml", overrides);
}

std::string error_of(const std::string& text, std::int64_t frame = 0) {
  try {
    scene_at(text, frame);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// An animation of the field of view.
std::string zoom(const std::string& keys) {
  return "[[animation]]\npath = \"camera.fov\"\n" + keys;
}

double fov_at(const std::string& keys, std::int64_t frame) {
  return scene_at(zoom(keys), frame).camera.fov;
}

/// A small scene in which a ball crosses light in fog.
constexpr const char* film = R"([camera]
position = [0, 0.2, 3.1]
[image]
width = 24
height = 16
[render]
spp = 8
[[media]]
albedo = 1
sigma_t = 1
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[lights]]
type = "directional"
irradiance = 20
direction = [-1, -1, 0.2]
[[objects]]
type = "sphere"
radius = 0.4
[[animation]]
path = "objects.0.translate.0"
frames = [0, 4]
values = [-0.5, 0.5]
)";

}  // namespace

// ---- keys

TEST(Animation, goes_straight_between_linear_keys_and_is_held_outside) {
  const std::string keys = "frames = [2, 4, 8]\nvalues = [10, 20, 60]\n";
  const double expected[] = {10, 10, 10, 15, 20, 30, 40, 50, 60, 60};
  for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(fov_at(keys, frame), expected[frame]) << frame;
}

TEST(Animation, of_one_key_is_constant) {
  for (const char* way : {"linear", "smooth", "step"})
    for (const int frame : {0, 3, 9})
      EXPECT_EQ(
          fov_at("frames = [3]\nvalues = [30]\ninterpolation = \"" + std::string(way) + "\"\n",
                 frame),
          30);
}

TEST(Animation, stays_at_a_step_until_the_next) {
  const std::string keys = "frames = [2, 5]\nvalues = [10, 20]\ninterpolation = \"step\"\n";
  EXPECT_EQ(fov_at(keys, 0), 10);
  EXPECT_EQ(fov_at(keys, 4), 10);
  EXPECT_EQ(fov_at(keys, 5), 20);
  EXPECT_EQ(fov_at(keys, 9), 20);
}

TEST(Animation, eases_between_two_smooth_keys) {
  const std::string keys = "frames = [0, 10]\nvalues = [20, 40]\ninterpolation = \"smooth\"\n";
  for (int frame = 0; frame <= 10; ++frame) {
    const double u = frame / 10.;
    EXPECT_NEAR(fov_at(keys, frame), 20 + 20 * u * u * (3 - 2 * u), 1e-12) << frame;
  }
}

TEST(Animation, is_smooth_and_keeps_between_its_keys) {
  // A plateau, a steep rise, a turn and a slow fall, at uneven distances: where a plain Catmull-Rom
  // curve would leave the range (0, 180) of a field of view.
  const double t[] = {0, 10, 12, 40, 100}, y[] = {1, 1, 179, 100, 90};
  const std::string keys = zoom(
      "frames = [0, 10, 12, 40, 100]\nvalues = [1, 1, 179, 100, 90]\ninterpolation = \"smooth\"\n");
  // A thousand frames a second against keys in seconds, so that steps are small.
  const std::string fine = zoom(
      "seconds = [0, 10, 12, 40, 100]\nvalues = [1, 1, 179, 100, 90]\ninterpolation = "
      "\"smooth\"\n");
  const auto at = [&](double time) {
    return scene_at(fine + "[render]\nfps = 1000\n", std::llround(1000 * time)).camera.fov;
  };
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(scene_at(keys, int(t[i])).camera.fov, y[i], 1e-12);
  double before = at(0);
  for (int i = 0; i < 4; ++i)
    for (double time = t[i]; time < t[i + 1]; time += (t[i + 1] - t[i]) / 20) {
      const double now = at(time);
      EXPECT_GE(now, std::min(y[i], y[i + 1]) - 1e-9);
      EXPECT_LE(now, std::max(y[i], y[i + 1]) + 1e-9);
      if (y[i + 1] >= y[i]) {
        EXPECT_GE(now, std::min(before, y[i]) - 1e-9);
      }
      before = now;
    }
  for (int i = 1; i < 4; ++i) {  // slopes agree on both sides of a key, to the step's order
    const double h = 1e-3;
    EXPECT_NEAR((at(t[i]) - at(t[i] - h)) / h, (at(t[i] + h) - at(t[i])) / h, 0.5) << i;
  }
}

TEST(Animation, takes_its_keys_in_seconds) {
  const std::string keys = zoom("seconds = [0, 2]\nvalues = [20, 40]\n");
  EXPECT_EQ(scene_at(keys, 24).camera.fov, 30);  // at 24 frames a second
  EXPECT_EQ(scene_at(keys + "[render]\nfps = 10\n", 5).camera.fov, 25);
}

TEST(Animation, steps_at_the_frame_that_its_seconds_name) {
  // In doubles 0.28 * 25 is a little more than 7.
  const std::string keys = zoom("seconds = [0, 0.28]\nvalues = [20, 40]\ninterpolation = 'step'\n");
  EXPECT_EQ(scene_at(keys + "[render]\nfps = 25\n", 6).camera.fov, 20);
  EXPECT_EQ(scene_at(keys + "[render]\nfps = 25\n", 7).camera.fov, 40);
}

TEST(Animation, changes_vectors_colours_and_their_components) {
  const std::string text = std::string(film) + R"(
[[animation]]
path = "camera.position"
frames = [0, 2]
values = [[0, 0, 4], [2, 0, 8]]
[[animation]]
path = "background"
frames = [0, 2]
values = [[0, 0, 1], [1, 0, 0]]
[[animation]]
path = "lights.0.direction.2"
frames = [0, 2]
values = [0, 1]
)";
  const Scene scene = scene_at(text, 1);
  EXPECT_EQ(scene.camera.position, Vec3<double>(1, 0, 6));
  EXPECT_EQ(scene.background, Rgb<double>(0.5, 0, 0.5));
  const Vec3<double> direction = std::get<Directional>(scene.lights.at(0)).direction;
  EXPECT_NEAR(direction.z / direction.x, -0.5, 1e-15);
  EXPECT_EQ(std::get<Sphere>(scene.objects.at(0).geometry).centre.x, -0.25);
}

TEST(Animation, changes_a_part_of_a_default) {
  const std::string text =
      "[[animation]]\npath = \"camera.position.1\"\nframes = [0, 2]\nvalues = [0, 4]\n";
  EXPECT_EQ(scene_at(text, 1).camera.position, Vec3<double>(0, 2, 5));
  EXPECT_EQ(scene_at(text, 1, {"camera.position.0=3"}).camera.position, Vec3<double>(3, 2, 5));
}

TEST(Animation, rounds_whole_numbers_and_steps_through_words) {
  const std::string text = zoom("frames = [0, 9]\nvalues = [20, 40]\n") + R"(
[[animation]]
path = "image.width"
frames = [0, 4]
values = [10, 20]
[[animation]]
path = "render.filter"
frames = [0, 3]
values = ["box", "gaussian"]
interpolation = "step"
)";
  EXPECT_EQ(scene_at(text, 0).resolution.width, 10);
  EXPECT_EQ(scene_at(text, 1).resolution.width, 13);  // 12.5
  EXPECT_EQ(scene_at(text, 2).render.filter, PixelFilter::box);
  EXPECT_EQ(scene_at(text, 3).render.filter, PixelFilter::gaussian);
}

TEST(Animation, yields_to_what_the_user_says) {
  const std::string text = zoom("frames = [0, 4]\nvalues = [20, 40]\n");
  EXPECT_EQ(scene_at(text, 2, {"camera.fov=77"}).camera.fov, 77);
  EXPECT_EQ(scene_at(text, 2, {"animation.0.values.1=60"}).camera.fov, 40);
}

// ---- mistakes

TEST(Animation, tells_where_keys_are_wrong) {
  EXPECT_EQ(error_of(zoom("values = [1]\n")),
            "film.toml:1:1: animation.0 does not say when its keys are; accepted: frames, or "
            "seconds");
  EXPECT_THAT(error_of(zoom("frames = [0]\nseconds = [0]\nvalues = [1]\n")),
              StartsWith("film.toml:1:1: animation.0 says twice when its keys are"));
  EXPECT_EQ(error_of(zoom("frames = []\nvalues = []\n")),
            "film.toml:3:10: animation.0.frames = [] is empty: accepted is at least one key");
  EXPECT_EQ(error_of(zoom("frames = [0, 4, 4]\nvalues = [1, 2, 3]\n")),
            "film.toml:3:17: animation.0.frames.2 = 4 does not come after the key before it: "
            "accepted are ascending keys");
  EXPECT_EQ(error_of(zoom("frames = [0, 4]\nvalues = [1, 2, 3]\n")),
            "film.toml:4:10: animation.0.values has 3 values for 2 keys: accepted is one for each");
  EXPECT_EQ(error_of(zoom("frames = [0, 4]\nvalues = [1, [2, 3]]\n")),
            "film.toml:4:14: animation.0.values.1 = [2, 3] is of another kind than the other keys' "
            "values");
  EXPECT_THAT(error_of(zoom("frames = [0, 4]\nvalues = [1, \"x\"]\n")),
              StartsWith("film.toml:4:14: animation.0.values.1 = \"x\" is not a number"));
  EXPECT_THAT(error_of(zoom("frames = [0, nan]\nvalues = [1, 2]\n")), HasSubstr("is not finite"));
  EXPECT_THAT(error_of(zoom("frames = [0]\nvalues = [1]\ninterpolation = \"cubic\"\n")),
              HasSubstr("is not known here; accepted: linear, smooth, step"));
  EXPECT_THAT(error_of(zoom("frames = [0]\n")), HasSubstr("animation.0.values is missing"));
  EXPECT_THAT(error_of("[[animation]]\nframes = [0]\nvalues = [1]\n"),
              HasSubstr("animation.0.path is missing"));
}

TEST(Animation, tells_where_a_path_leads_nowhere) {
  const auto of_path = [](const std::string& path) {
    return error_of("[[animation]]\npath = \"" + path + "\"\nframes = [0]\nvalues = [1]\n");
  };
  EXPECT_THAT(of_path("camera.fog"), StartsWith("film.toml:2:8: camera.fog is not known here"));
  EXPECT_EQ(of_path("objects.0.radius"),
            "film.toml:2:8: objects is not there; only as a whole can it be set");
  EXPECT_EQ(of_path("camera.position.3"),
            "film.toml:2:8: camera.position.3 is not known here; accepted: 0, 1, 2");
  EXPECT_THAT(of_path(""), HasSubstr("film.toml:2:8: a key is empty in the path"));
  for (const char* fixed : {"render.frame", "render.fps", "render", "animation.0.values.0"})
    EXPECT_THAT(of_path(fixed), HasSubstr("cannot change from frame to frame")) << fixed;
  const std::string keys = "frames = [0]\nvalues = [1]\n";
  EXPECT_EQ(error_of(zoom(keys) + zoom(keys)),
            "film.toml:6:8: animation.1.path = \"camera.fov\" is changed already by animation.0");
}

TEST(Animation, tells_where_a_value_is_out_of_range_or_of_the_wrong_kind) {
  const std::string text = zoom("frames = [0, 4]\nvalues = [20, 220]\n");
  EXPECT_EQ(error_of(text, 3), "");
  const std::string range =
      "is out of range: a number in (0, 180) degrees (vertical field of view)";
  EXPECT_EQ(
      error_of(zoom("frames = [0, 4]\nvalues = [20, 236]\n"), 3),
      "film.toml:4:11: camera.fov = 182, at frame 3, between the keys at 4:11 and 4:15, " + range);
  EXPECT_EQ(error_of(text, 4), "film.toml:4:15: camera.fov = 220, at frame 4, " + range);
  EXPECT_EQ(error_of(text, 9), "film.toml:4:15: camera.fov = 220, at frame 9, " + range);
  EXPECT_THAT(
      error_of("[[animation]]\npath = \"camera.target\"\nframes = [0]\nvalues = [[1, 2]]\n"),
      StartsWith("film.toml:4:11: camera.target = [1, 2] has 2 numbers, not 3"));
}

// ---- frames of a file

TEST(SceneFile, gives_each_frame_as_it_is_loaded_alone) {
  const Folder folder;
  write_bytes(folder / "film.toml", film);
  const SceneFile file(folder / "film.toml", {"render.spp=4"});
  for (const int frame : {3, 0, 1}) {
    const Scene scene = file.scene(frame);
    EXPECT_EQ(scene.render.frame, frame);
    EXPECT_EQ(scene.render.spp, 4);
    EXPECT_EQ(std::get<Sphere>(scene.objects.at(0).geometry).centre.x, -0.5 + 0.25 * frame);
    const Scene alone =
        load_scene(folder / "film.toml", {"render.spp=4", "render.frame=" + std::to_string(frame)});
    EXPECT_EQ(std::get<Sphere>(alone.objects.at(0).geometry).centre.x, -0.5 + 0.25 * frame);
  }
}

TEST(SceneFile, reads_models_and_pictures_once) {
  const Folder folder;
  write_bytes(folder / "part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_bytes(folder / "film.toml",
              "[[objects]]\ntype = \"mesh\"\nfile = \"part.obj\"\n"
              "[[animation]]\npath = \"objects.0.scale\"\nframes = [0, 1]\n"
              "values = [1, 2]\n");
  const SceneFile file(folder / "film.toml");
  EXPECT_EQ(file.scene(0).objects.size(), 1u);
  std::filesystem::remove(folder / "part.obj");
  const Scene scene = file.scene(1);
  EXPECT_EQ(std::get<Mesh>(scene.objects.at(0).geometry).positions.at(1).x, 2);
}

TEST(SceneFile, finds_files_beside_it_from_a_relative_path) {
  const Folder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::create_directory(folder / "scenes");
  write_bytes(folder / "scenes/body.obj",
              "v -1 -1 -1\nv 1 -1 -1\nv 0 1 -1\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  write_bytes(folder / "scenes/film.toml",
              "[[objects]]\ntype = \"mesh\"\nfile = \"body.obj\"\n[[media]]\nalbedo = 1\n"
              "sigma_t = 1\nshape = {type = \"mesh\", file = \"body.obj\"}\n");
  std::filesystem::current_path(folder / "");
  EXPECT_NO_THROW(load_scene("scenes/film.toml"));
  const SceneFile file("scenes/film.toml");
  EXPECT_EQ(file.scene(1).objects.size(), 1u);
  std::filesystem::current_path(before);
}

TEST(SceneFile, takes_the_plate_of_each_frame) {
  const Folder folder;
  write_bytes(folder / "film.toml",
              "background_image = \"plate.##.pfm\"\n[image]\nwidth = 1\n"
              "height = 1\n");
  const std::string header = "PF\n1 1\n-1\n";
  const float dark[] = {0, 0, 0}, bright[] = {2, 2, 2};
  write_bytes(folder / "plate.00.pfm",
              header + std::string(reinterpret_cast<const char*>(dark), sizeof dark));
  write_bytes(folder / "plate.12.pfm",
              header + std::string(reinterpret_cast<const char*>(bright), sizeof bright));
  const SceneFile file(folder / "film.toml");
  EXPECT_EQ(file.scene(0).background_image.pixels.at(0), 0);
  EXPECT_EQ(file.scene(12).background_image.pixels.at(0), 2);
  EXPECT_THROW(file.scene(1), Error);
}

TEST(SceneFile, finds_bad_values_of_a_later_frame_without_building_it) {
  const Folder folder;
  write_bytes(folder / "film.toml", zoom("frames = [0, 4]\nvalues = [20, 220]\n") +
                                        "[[objects]]\ntype = \"mesh\"\nfile = \"none.obj\"\n");
  const SceneFile file(folder / "film.toml");
  EXPECT_NO_THROW(file.check(0));
  EXPECT_THROW(file.check(4), Error);
  EXPECT_THROW(file.scene(0), Error);
}

TEST(Numbered, puts_the_number_where_the_name_says) {
  EXPECT_EQ(numbered("a.#/out.####.png", 17), "a.#/out.0017.png");
  EXPECT_EQ(numbered("#.png", 123), "123.png");
  EXPECT_EQ(numbered("out.png", 3), "out.png");
  EXPECT_THROW(numbered("#a#.png", 3), Error);
  EXPECT_TRUE(is_pattern("out.##.exr"));
  EXPECT_FALSE(is_pattern("a.#/out.exr"));
}

// ---- noise

TEST(Noise, is_new_in_every_frame_or_still) {
  Scene scene = parse_scene(film, "film.toml");
  const auto picture = [&](std::int64_t frame, Noise noise) {
    scene.render.frame = frame;
    scene.render.noise = noise;
    return render(scene).film.radiance(12, 8).g;
  };
  const double first = picture(0, Noise::per_frame);
  EXPECT_EQ(picture(0, Noise::still), first);
  EXPECT_EQ(picture(7, Noise::still), first);
  EXPECT_NE(picture(7, Noise::per_frame), first);
  EXPECT_NE(picture(8, Noise::per_frame), picture(7, Noise::per_frame));
  EXPECT_EQ(picture(7, Noise::per_frame), picture(7, Noise::per_frame));
}

// ---- models that move

namespace {

/// A glTF file with a triangle that an animation moves.
struct MovingTriangle : GltfBuilder {
  int node_index;

  MovingTriangle() {
    node_index = node({{"attributes", {{"POSITION", positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    json["animations"] = nlohmann::json::array();
  }

  void move(const std::string& path, const std::vector<float>& times, const std::string& type,
            int components, const std::vector<float>& values, const std::string& way = "LINEAR") {
    const int input = accessor(times, 5126, "SCALAR", 1);
    const int output = accessor(values, 5126, type, components);
    json["animations"].push_back(
        {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", way}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node_index}, {"path", path}}}}}}});
  }

  /// The corner that starts at (1, 0, 0), at a time.
  Vec3<double> corner_at(double seconds) const {
    const Folder folder;
    write_bytes(folder / "a.glb", glb());
    const Model model = ModelFile(folder / "a.glb").at(seconds);
    return Vec3<double>(std::get<Mesh>(model.objects.at(0).geometry).positions.at(1));
  }

  std::string error() const {
    try {
      corner_at(0);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
};

void expect_near(const Vec3<double>& a, const Vec3<double>& b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << ", " << a.y << ", " << a.z;  // positions are floats
}

}  // namespace

TEST(MovingModel, goes_from_key_to_key) {
  MovingTriangle model;
  model.move("translation", {1, 3}, "VEC3", 3, {0, 0, 0, 0, 4, 0});
  expect_near(model.corner_at(0), {1, 0, 0});
  expect_near(model.corner_at(1.5), {1, 1, 0});
  expect_near(model.corner_at(9), {1, 4, 0});
}

TEST(MovingModel, stays_at_steps) {
  MovingTriangle model;
  model.move("scale", {0, 1}, "VEC3", 3, {1, 1, 1, 3, 1, 1}, "STEP");
  expect_near(model.corner_at(0.99), {1, 0, 0});
  expect_near(model.corner_at(1), {3, 0, 0});
}

TEST(MovingModel, turns_along_the_shorter_arc) {
  MovingTriangle model;
  const float half = std::sqrt(0.5F);
  // A quarter turn about z, its end said by the opposite quaternion.
  model.move("rotation", {0, 1}, "VEC4", 4, {0, 0, 0, 1, 0, 0, -half, -half});
  for (const double t : {0., 0.25, 0.5, 1.})
    expect_near(model.corner_at(t), {std::cos(t * pi / 2), std::sin(t * pi / 2), 0});
}

TEST(MovingModel, follows_cubic_splines) {
  MovingTriangle model;
  // Slopes in 1/s over an interval of 2 s: x(u) = 2 (u³ − 2u² + u) · 3 + 4 (3u² − 2u³).
  model.move("translation", {0, 2}, "VEC3", 3,
             {0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0}, "CUBICSPLINE");
  for (const double u : {0.25, 0.5, 0.75})
    expect_near(model.corner_at(2 * u),
                {1 + 6 * (u * u * u - 2 * u * u + u) + 4 * (3 * u * u - 2 * u * u * u), 0, 0});
}

TEST(MovingModel, moves_what_stands_on_what_moves_and_the_camera) {
  MovingTriangle model;
  model.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  model.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 3}}};
  model.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
  model.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  model.json["nodes"][0]["children"] = {1, 2};
  model.move("translation", {0, 1}, "VEC3", 3, {0, 0, 0, 10, 0, 0});
  const float half = std::sqrt(0.5F);
  model.move("rotation", {0, 1}, "VEC4", 4, {0, 0, 0, 1, half, 0, 0, half});
  const Folder folder;
  write_bytes(folder / "a.glb", model.glb());
  const SceneFile file(folder / "a.glb", {"render.fps=10"});
  const Scene start = file.scene(0), end = file.scene(10);
  expect_near(start.camera.position, {0, 0, 5});
  expect_near(end.camera.position, {10, -5, 0});  // the quarter turn about x takes z to −y
  expect_near(std::get<Directional>(start.lights.at(0)).direction, {0, 0, -1});
  expect_near(std::get<Directional>(end.lights.at(0)).direction, {0, 1, 0});
  // What is made up stays in its place.
  EXPECT_EQ(std::get<Box>(start.media[0].shape).min, std::get<Box>(end.media[0].shape).min);
}

TEST(MovingModel, takes_the_shapes_of_morph_targets) {
  MovingTriangle model;
  model.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", model.positions({0, 0, 0, 0, 0, 1, 0, 0, 0})}},
      {{"POSITION", model.positions({0, 0, 0, 0, 4, 0, 0, 0, 0})}},
      {{"POSITION", model.positions({0, 0, 0, 9, 9, 9, 0, 0, 0})}}};
  expect_near(model.corner_at(0), {1, 0, 0});
  model.json["meshes"][0]["weights"] = {0.5, 0, 0};
  expect_near(model.corner_at(0), {1, 0, 0.5});
  model.json["nodes"][0]["weights"] = {-1, 0.25, 0};
  model.json["nodes"][0]["scale"] = {1, 1, 2};
  expect_near(model.corner_at(0), {1, 1, -2});
  model.move("weights", {0, 2}, "SCALAR", 1, {0, 0, 0, 1, 0.5, 0});
  expect_near(model.corner_at(1), {1, 1, 1});
  model.json["animations"].clear();
  // Slopes in, values, slopes out of each key.
  model.move("weights", {0, 1}, "SCALAR", 1, {0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0},
             "CUBICSPLINE");
  expect_near(model.corner_at(0.5), {1, 4 * (8 * 0.125), 2 * 0.5});
  model.json["animations"].clear();
  model.move("weights", {0, 2}, "SCALAR", 1, {0, 0, 0, 1, 0.5});
  EXPECT_THAT(model.error(), HasSubstr("sampler.output: 5 elements"));
}

TEST(MovingModel, follows_the_joints_of_its_skin) {
  MovingTriangle model;
  auto& attributes = model.json["meshes"][0]["primitives"][0]["attributes"];
  // All of (0, 0, 0) to joint 0; of (1, 0, 0) a quarter to joint 0, the rest, in whole numbers that
  // make 200, to joint 1; (0, 1, 0) to nothing.
  attributes["JOINTS_0"] = model.accessor(
      std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1, 0, 9, 9, 9, 9, 9}, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = model.accessor(
      std::vector<std::uint8_t>{255, 0, 0, 0, 50, 150, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4);
  model.json["accessors"].back()["normalized"] = true;
  model.json["nodes"][0]["skin"] = 0;
  model.json["nodes"][0]["translation"] = {100, 0, 0};  // a skin does not heed it
  model.json["nodes"].push_back({{"translation", {0, 0, 4}}, {"children", {2}}});
  model.json["nodes"].push_back({{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}});
  const std::vector<float> bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 8, 1};
  model.json["skins"] = {
      {{"joints", {1, 2}}, {"inverseBindMatrices", model.accessor(bind, 5126, "MAT4", 16)}}};
  // Joint 0 takes the corner to (1, 0, 4); joint 1 by way of (0, 0, 8) to (1, 0, 4 + 16).
  expect_near(model.corner_at(0), {1, 0, 16});
  const Folder folder;
  write_bytes(folder / "a.glb", model.glb());
  const Model still = load_model(folder / "a.glb");
  EXPECT_THAT(still.remarks, IsEmpty());
  expect_near(Vec3<double>(std::get<Mesh>(still.objects[0].geometry).positions[2]), {100, 1, 0});

  model.node_index = 2;
  model.move("translation", {0, 1}, "VEC3", 3, {1, 0, 0, 5, 0, 0});
  expect_near(model.corner_at(1), {4, 0, 16});

  model.json["skins"][0].erase("inverseBindMatrices");  // then they are as they stand
  expect_near(model.corner_at(0), {0.25 + 0.75 * 3, 0, 4});
  model.json["skins"][0]["joints"] = {1};
  EXPECT_THAT(model.error(), HasSubstr("vertex 1 is bound to joint 1; a joint below 1"));
  model.json["skins"][0] = {{"joints", {1, 2}}, {"inverseBindMatrices", 0}};
  EXPECT_THAT(model.error(), HasSubstr("accessors[0] has elements of another type"));
  model.json["skins"][0]["joints"] = {1, 7};
  EXPECT_THAT(model.error(), HasSubstr("skins[0].joints[1]: 7; an index"));
  model.json["skins"][0] = {{"joints", {1, 2}}};
  model.json["scenes"] = {{{"nodes", {0}}}};
  expect_near(model.corner_at(0), {101, 0, 0});  // its joints are not in the scene
}

TEST(MovingModel, says_what_it_leaves_out) {
  MovingTriangle model;
  model.move("translation", {0, 1}, "VEC3", 3, {0, 0, 0, 2, 0, 0});
  model.move("translation", {0, 1}, "VEC3", 3, {0, 0, 0, 0, 2, 0});
  const Folder folder;
  write_bytes(folder / "a.glb", model.glb());
  EXPECT_THAT(load_model(folder / "a.glb").remarks,
              ElementsAre("where several animations move the same node, the first does"));
  expect_near(model.corner_at(1), {3, 0, 0});
}

TEST(MovingModel, refuses_broken_keys) {
  const auto error_after = [](auto&& change) {
    MovingTriangle model;
    model.move("translation", {0, 1}, "VEC3", 3, {0, 0, 0, 1, 0, 0});
    change(model.json);
    return model.error();
  };
  EXPECT_EQ(error_after([](auto&) {}), "");
  EXPECT_THAT(
      error_after([](auto& j) { j["animations"][0]["channels"][0]["sampler"] = 3; }),
      HasSubstr("animations[0].channels[0].sampler: 3; an index from 0 to 0 into samplers"));
  EXPECT_THAT(
      error_after([](auto& j) { j["animations"][0]["channels"][0]["target"]["path"] = "colour"; }),
      HasSubstr("translation, rotation, scale, weights"));
  EXPECT_THAT(error_after([](auto& j) { j["animations"][0]["samplers"][0].erase("input"); }),
              HasSubstr("animations[0].samplers[0].input: missing"));
  EXPECT_THAT(error_after([](auto& j) {
                j["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
              }),
              HasSubstr("animations[0].channels[0].sampler.output: 2 elements; 6 for 2 keys"));
  EXPECT_THAT(error_after([](auto& j) {
                j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
              }),
              HasSubstr("it moves nodes[0], which has a matrix"));
  EXPECT_THAT(error_after([](auto& j) { j["animations"] = 3; }), HasSubstr("animations: 3"));
  MovingTriangle backwards;
  backwards.move("translation", {1, 0}, "VEC3", 3, {0, 0, 0, 1, 0, 0});
  EXPECT_THAT(backwards.error(), HasSubstr("time 1 is not after the one before"));
}

// ---- a run of frames

namespace {

struct Desk : test::SceneDesk {
  Desk() : SceneDesk("film.toml", film) {}
};

/// A line on stderr, exit status 2, and no file.
void expect_refused(const Desk& desk, const Outcome& outcome, const std::string& said) {
  test::expect_refused(outcome, said);
  EXPECT_THAT(desk.folder.names(), ElementsAre("film.toml"));
}

}  // namespace

TEST(Frames, are_the_same_alone_and_in_a_run) {
  const Desk desk;
  const Outcome all = desk.render("all.##.pfm", {"--frames", "2..4"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(std::ranges::count(all.out, '\n'), 3);
  EXPECT_EQ(desk.render("one.###.pfm", {"--frames", "3"}).status, 0);
  EXPECT_EQ(desk.render("plain.pfm", {"--frame", "3"}).status, 0);
  EXPECT_THAT(desk.folder.names(), ElementsAre("all.02.pfm", "all.03.pfm", "all.04.pfm",
                                               "film.toml", "one.003.pfm", "plain.pfm"));
  EXPECT_EQ(bytes_of(desk.folder / "all.03.pfm"), bytes_of(desk.folder / "one.003.pfm"));
  EXPECT_EQ(bytes_of(desk.folder / "all.03.pfm"), bytes_of(desk.folder / "plain.pfm"));
  EXPECT_NE(bytes_of(desk.folder / "all.03.pfm"), bytes_of(desk.folder / "all.02.pfm"));
}

TEST(Frames, are_taken_up_where_a_run_ended) {
  const Desk desk;
  EXPECT_EQ(desk.render("out.#.png", {"--frames", "1..2"}).status, 0);
  write_bytes(desk.folder / "out.1.png", "kept");
  const Outcome rest = desk.render("out.#.png", {"--frames", "0..3", "--skip-existing"});
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.out, StartsWith("2 of 4 frames are there already\n"));
  EXPECT_EQ(bytes_of(desk.folder / "out.1.png"), "kept");
  EXPECT_THAT(desk.folder.names(),
              ElementsAre("film.toml", "out.0.png", "out.1.png", "out.2.png", "out.3.png"));
  EXPECT_EQ(desk.render("out.#.png", {"--frames", "1"}).status, 0);
  EXPECT_NE(bytes_of(desk.folder / "out.1.png"), "kept");
}

TEST(Frames, are_given_as_a_run_or_as_one) {
  const Desk desk;
  test::expect_refused(
      desk.render("out.#.png", {"--frames", "0..1", "--frame", "7"}),
      "--frame 7: the frames are those of --frames 0..1; accepted: one of the two");
  EXPECT_THAT(desk.folder.names(), ElementsAre("film.toml"));
}

TEST(Frames, that_an_interrupt_cut_short_are_not_written) {
  const Desk desk;
  const Outcome outcome = run({"render", desk.scene, "-o", desk.folder / "out.#.png", "--frames",
                               "0..3", "--size", "64x64", "--spp", "268435456"},
                              {.during = [](pid_t child) {
                                usleep(700'000);
                                kill(child, SIGINT);
                              }});
  EXPECT_EQ(outcome.status % 1000, outcome.status >= 1000 ? SIGINT : 128 + SIGINT);
  EXPECT_THAT(desk.folder.names(), ElementsAre("film.toml"));
}

TEST(Frames, that_the_time_limit_cuts_short_are_not_written) {
  const Desk desk;
  // The first frame is soon done, the second would never be.
  write_bytes(desk.scene, std::string(film) +
                              "[[animation]]\npath = \"render.spp\"\nframes = [0, 1]\n"
                              "values = [1, 268435456]\ninterpolation = \"step\"\n");
  const std::vector<std::string> flags = {"--frames", "0..5",         "--time-limit",
                                          "2",        "--size",       "64x64",
                                          "--isa",    "baseline",     "--skip-existing",
                                          "--resume", "--checkpoint", desk.folder / "out.#.ckpt"};
  const Outcome outcome = desk.render("out.#.png", flags);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              testing::EndsWith(
                  "frame 1 is cut short by the time limit and not written; 1 of 6 are there\n"));
  EXPECT_THAT(desk.folder.names(),
              ElementsAre("film.toml", "out.0.ckpt", "out.0.png", "out.1.ckpt"));
}

TEST(Frames, go_on_in_the_middle_of_one_from_its_checkpoint) {
  const Desk whole, parts;
  const auto render = [&](const std::string& output, const std::string& spp) {
    return parts.render(output, {"--frames", "0..2", "--spp", spp, "--samples-per-ray", "1",
                                 "--checkpoint", parts.folder / "out.#.ckpt", "--resume"});
  };
  ASSERT_EQ(render("half.#.pfm", "8").status, 0);
  ASSERT_EQ(render("out.#.pfm", "16").status, 0);
  ASSERT_EQ(whole.render("out.#.pfm", {"--frames", "0..2", "--spp", "16", "--samples-per-ray", "1"})
                .status,
            0);
  for (const char* name : {"out.0.pfm", "out.1.pfm", "out.2.pfm"}) {
    const Image a = read_image(whole.folder / name), b = read_image(parts.folder / name);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      ASSERT_NEAR(a.pixels[i], b.pixels[i], 3e-6f * (1 + a.pixels[i])) << name;
  }
  // Every frame has its own: that of another is another render.
  std::filesystem::copy_file(parts.folder / "out.0.ckpt", parts.folder / "out.3.ckpt");
  const Outcome outcome =
      parts.render("out.#.pfm", {"--frames", "3", "--spp", "16", "--samples-per-ray", "1",
                                 "--checkpoint", parts.folder / "out.#.ckpt", "--resume"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("out.3.ckpt: is of another render: "));
}

TEST(Frames, find_what_is_in_the_way_of_a_checkpoint_before_the_first) {
  const Desk desk;
  write_bytes(desk.folder / "out.2.ckpt", "another's");
  const Outcome outcome =
      desk.render("out.#.png", {"--frames", "0..2", "--checkpoint", desk.folder / "out.#.ckpt"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("out.2.ckpt: is there already; accepted: a new file, or"));
  EXPECT_THAT(desk.folder.names(), ElementsAre("film.toml", "out.2.ckpt"));
  EXPECT_EQ(bytes_of(desk.folder / "out.2.ckpt"), "another's");
  const Outcome single =
      desk.render("out.#.png", {"--frames", "0..1", "--checkpoint", desk.folder / "one.ckpt"});
  EXPECT_EQ(single.status, 2);
  EXPECT_THAT(single.err, HasSubstr("one.ckpt: has no place for the number of a frame"));
}

TEST(Frames, are_whole_however_often_the_run_is_killed) {
  const Desk whole, killed;
  const std::vector<std::string> flags = {"--frames", "0..7", "--skip-existing"};
  ASSERT_EQ(whole.render("out.#.pfm", flags).status, 0);
  for (int i = 1; i <= 6; ++i)
    run({"render", killed.scene, "-o", killed.folder / "out.#.pfm", "--frames", "0..7",
         "--skip-existing"},
        {.during = [&](pid_t child) {
          usleep(useconds_t(i * 12'000));
          kill(child, SIGKILL);
        }});
  EXPECT_EQ(killed.render("out.#.pfm", flags).status, 0);
  for (int i = 0; i < 8; ++i) {
    const std::string name = "out." + std::to_string(i) + ".pfm";
    EXPECT_EQ(bytes_of(whole.folder / name), bytes_of(killed.folder / name)) << name;
  }
}

TEST(Frames, want_a_place_for_their_number) {
  const Desk desk;
  expect_refused(desk, desk.render("out.png", {"--frames", "0..3"}),
                 "out.png: has no place for the number of a frame");
  expect_refused(desk, desk.render("out.##.png", {}), "out.##.png: # stands for the number");
  expect_refused(desk, desk.render("#.#.png", {"--frames", "1"}), "has # in two places");
  expect_refused(desk,
                 run({"render", desk.scene, "-o", desk.folder / "a.#.png", "-o",
                      desk.folder / "a.exr", "--frames", "0..3"}),
                 "a.exr: has no place");
}

TEST(Frames, are_refused_where_they_make_no_sense) {
  const Desk desk;
  for (const char* bad :
       {"a", "1..", "..3", "0...3", "-1..3", "1.5..3", "0..16777217", "1,2", "1..2..3"})
    expect_refused(desk, desk.render("out.#.png", {"--frames", bad}),
                   "--frames " + std::string(bad) + ": are no frames; accepted: FIRST..LAST");
  expect_refused(desk, desk.render("out.#.png", {"--frames", "4..3"}), "--frames 4..3: is empty");
  expect_refused(desk, desk.render("out.#.png", {"--frames", "0..3", "--preview", "1"}),
                 "--preview does not go with --frames");
}

TEST(SceneFile, finds_media_that_run_into_each_other_and_a_camera_at_its_target) {
  const Folder folder;
  const auto told = [&](const std::string& path, const std::string& values) {
    write_bytes(folder / "film.toml",
                fmt::format("[[media]]\nsigma_s = 1\nsigma_a = 0\n"
                            "shape = {{type = \"box\", max = [0, 1, 1]}}\n"
                            "[[media]]\nsigma_s = 2\nsigma_a = 0\n"
                            "shape = {{type = \"box\", min = [0, -1, -1]}}\n"
                            "[[animation]]\npath = \"{}\"\nframes = [0, 4]\nvalues = {}\n",
                            path, values));
    const SceneFile file(folder / "film.toml");
    EXPECT_NO_THROW(file.check(0)) << path;
    try {
      file.check(4);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(told("media.1.shape.min.0", "[0, -0.5]"),
              AllOf(HasSubstr("media hold two that overlap"), EndsWith("(at frame 4)")));
  EXPECT_THAT(told("media.1.shape.min.0", "[0, 1.5]"), HasSubstr("inverted box"));
  EXPECT_THAT(told("camera.position.2", "[5, 0]"), EndsWith("(at frame 4)"));
}

TEST(Frames, find_a_plate_that_is_not_there_before_the_first) {
  const Desk desk;
  ASSERT_EQ(desk.render("plate.#.png", {"--frames", "0..1"}).status, 0);
  const std::string plates = desk.folder / "plate.#.png";
  const Outcome outcome = desk.render("out.#.png", {"--frames", "0..2", "--background", plates});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, fmt::format("--background {}: background_image names a picture that is "
                                     "not there: {} (at frame 2)\n",
                                     plates, (desk.folder / "plate.2.png").string()));
  EXPECT_THAT(desk.folder.names(), ElementsAre("film.toml", "plate.0.png", "plate.1.png"));
}

TEST(Frames, are_all_checked_before_the_first_is_rendered) {
  const Desk desk;
  write_bytes(desk.scene, film + zoom("frames = [0, 9]\nvalues = [20, 220]\n"));
  expect_refused(desk, desk.render("out.#.png", {"--frames", "0..9"}), "camera.fov = 19");
}

}  // namespace airlight
