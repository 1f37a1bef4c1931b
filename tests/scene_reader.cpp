// What a scene file says, what it means, and what is said about its mistakes.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "error.h"
#include "render/film.h"
#include "scene/load_scene.h"
#include "scene/reader.h"
#include "support/folder.h"
#include "support/program.h"

namespace airlight {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string fog = R"([[media]]
sigma_s = 0.4
sigma_a = 0.1
shape = {type = "box"}
)";
const std::string sun = R"([[lights]]
type = "directional"
irradiance = 2
direction = [0, -1, 0]
)";

/// The error of a scene file "fog.toml", or "" if it is accepted.
std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_scene(text, "fog.toml", overrides);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

Medium medium_of(const std::string& keys) {
  return parse_scene("[[media]]\nshape = {type = \"box\"}\n" + keys, "fog.toml").media.at(0);
}

Vec3<double> direction_of(const std::string& keys) {
  const Scene scene =
      parse_scene("[[lights]]\ntype = \"directional\"\nirradiance = 1\n" + keys, "fog.toml");
  return std::get<Directional>(scene.lights.at(0)).direction;
}

void expect_near(const Vec3<double>& a, const Vec3<double>& b) {
  EXPECT_LT(length(a - b), 1e-15) << a.x << ", " << a.y << ", " << a.z;  // a rounding or two
}

}  // namespace

// --- what it means -------------------------------------------------------------------------------

TEST(SceneReader, takes_an_empty_file_for_the_defaults) {
  const Scene scene = parse_scene("", "fog.toml");
  EXPECT_EQ(scene.resolution.width, 640);
  EXPECT_EQ(scene.camera.position, Vec3<double>(0, 0, 5));
  EXPECT_EQ(scene.render.estimator, "rewv");
  EXPECT_TRUE(scene.media.empty());
}

TEST(SceneReader, reads_camera_image_surroundings_and_settings) {
  const Scene scene = parse_scene(R"(
background = [0.1, 0.2, 0.3]
ambient = 0.5
[camera]
position = [1, 2.5, 3]
target = [0, 1, 0]
fov = 60
[image]
width = 320
height = 200
[render]
estimator = "mcds"
filter = "gaussian"
samples_per_ray = 0
)",
                                  "fog.toml");
  EXPECT_EQ(scene.background, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.ambient, Rgb<double>(0.5));
  EXPECT_EQ(scene.camera.position, Vec3<double>(1, 2.5, 3));
  EXPECT_EQ(scene.camera.up, Vec3<double>(0, 1, 0));
  EXPECT_EQ(scene.camera.fov, 60);
  EXPECT_EQ(scene.resolution.width, 320);
  EXPECT_EQ(scene.resolution.height, 200);
  EXPECT_EQ(scene.render.estimator, "mcds");
  EXPECT_EQ(scene.render.filter, PixelFilter::gaussian);
  EXPECT_EQ(scene.render.samples_per_ray, 0);
}

TEST(SceneReader, takes_three_pairs_of_coefficients) {
  const Medium sum = medium_of("sigma_s = [0.1, 0.2, 0.3]\nsigma_a = 0.1\n");
  EXPECT_EQ(sum.sigma_s, Rgb<double>(0.1, 0.2, 0.3));
  EXPECT_EQ(sum.sigma_t, Rgb<double>(0.1 + 0.1, 0.2 + 0.1, 0.3 + 0.1));
  const Medium part = medium_of("albedo = 0.5\nsigma_t = [1, 2, 4]\n");
  EXPECT_EQ(part.sigma_s, Rgb<double>(0.5, 1, 2));
  EXPECT_EQ(part.sigma_t, Rgb<double>(1, 2, 4));
  const Medium seen = medium_of("albedo = [1, 0.5, 0]\nvisibility = 39.12\n");
  EXPECT_DOUBLE_EQ(seen.sigma_t.g, 0.1);
  EXPECT_DOUBLE_EQ(seen.sigma_s.g, 0.05);
  EXPECT_EQ(seen.sigma_s.b, 0);
}

TEST(SceneReader, reads_phase_functions_and_emission) {
  const Medium medium = medium_of(
      "albedo = 1\nsigma_t = 1\nemission = 0.25\nphase = {type = \"henyey-greenstein\", g = "
      "0.3}\n");
  EXPECT_EQ(std::get<HenyeyGreenstein>(medium.phase).g, 0.3);
  EXPECT_EQ(medium.emission, Rgb<double>(0.25));
  EXPECT_TRUE(std::holds_alternative<Rayleigh>(
      medium_of("albedo = 1\nsigma_t = 1\nphase = {type = \"rayleigh\"}\n").phase));
}

TEST(SceneReader, takes_the_direction_of_light_in_two_ways) {
  expect_near(direction_of("direction = [0, -3, 4]\n"), {0, -0.6, 0.8});
  expect_near(direction_of("direction = [1e-300, 0, 0]\n"), {1, 0, 0});
  expect_near(direction_of("azimuth = 0\nelevation = 0\n"), {0, 0, 1});    // from the north, -z
  expect_near(direction_of("azimuth = 90\nelevation = 0\n"), {-1, 0, 0});  // from the east, +x
  expect_near(direction_of("azimuth = 123\nelevation = 90\n"), {0, -1, 0});
}

TEST(SceneReader, loads_every_scene_of_the_project) {
  const test::Folder folder;
  std::filesystem::copy(AIRLIGHT_SOURCE_DIR "/scenes", folder / "",
                        std::filesystem::copy_options::recursive);
  // plate_room.toml wants a depth image that a render makes: here a PFM with a depth of 1 m.
  std::string depths = "Pf\n16 9\n-1.0\n";
  for (int i = 0; i < 16 * 9; ++i) depths += std::string("\0\0\x80\x3f", 4);
  test::write_bytes(folder / "depth.exr", depths);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = load_scene(entry.path());
    EXPECT_FALSE(scene.media.empty()) << entry.path();
    EXPECT_FALSE(scene.lights.empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST(SceneReader, gives_the_sphere_in_fog_the_factor_of_its_comment) {
  const Scene scene = load_scene(AIRLIGHT_SOURCE_DIR "/scenes/sphere_in_fog.toml");
  const double factor = scene.media[0].sigma_s.g * evaluate(scene.media[0].phase, 0.3) *
                        std::get<Directional>(scene.lights.at(0)).irradiance.g;
  EXPECT_NEAR(factor, 1.853, 1e-6);
}

// --- mistakes: the document ----------------------------------------------------------------------

TEST(SceneReader, says_where_toml_is_bad) {
  EXPECT_THAT(error_of("[camera]\nfov = = 3\n"), StartsWith("fog.toml:2:7: "));
  EXPECT_THAT(error_of("[camera]\nfov = 3\nfov = 4\n"), StartsWith("fog.toml:3:"));
  for (const char* text : {"x = ", "[a", "a = \"\n", "\xff\xfe", "a = 1e99999", "a.b = 1\na = 2"}) {
    EXPECT_THAT(error_of(text), StartsWith("fog.toml:")) << text;
    EXPECT_EQ(error_of(text).find('\n'), std::string::npos) << text;
  }
}

TEST(SceneReader, names_a_file_that_cannot_be_read) {
  try {
    load_scene("/no/such/fog.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "/no/such/fog.toml: cannot be read: No such file or directory");
  }
  EXPECT_THROW(load_scene(std::filesystem::temp_directory_path() / "."), Error);
}

TEST(SceneReader, names_the_endings_it_knows) {
  try {
    load_scene("fog.yaml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "fog.yaml: is no scene by its name; accepted: .glb, .gltf, .obj, .toml");
  }
}

TEST(SceneReader, names_the_accepted_keys_of_a_table) {
  EXPECT_EQ(error_of("[[media]]\nsigma_q = 1\n"),
            "fog.toml:2:1: media.0.sigma_q is not known here; accepted: albedo, emission, phase, "
            "shape, sigma_a, sigma_s, sigma_t, visibility");
  EXPECT_EQ(error_of("lamps = 1\n"),
            "fog.toml:1:1: lamps is not known here; accepted: ambient, animation, background, "
            "background_image, camera, image, lights, media, objects, render");
}

TEST(SceneReader, names_a_missing_key) {
  EXPECT_EQ(error_of("[[lights]]\ntype = \"directional\"\ndirection = [0, -1, 0]\n"),
            "fog.toml:1:1: lights.0.irradiance is missing; a number or [r, g, b], each of at least "
            "0 W/m2 (on a surface that faces the light, outside the medium)");
  EXPECT_EQ(error_of("[[lights]]\nirradiance = 1\n"),
            "fog.toml:1:1: lights.0.type is missing; accepted: collimated, directional");
}

TEST(SceneReader, names_the_words_where_one_is_wrong) {
  EXPECT_EQ(error_of("[render]\nfilter = \"bx\"\n"),
            "fog.toml:2:10: render.filter = \"bx\" is not known here; accepted: box, gaussian, "
            "tent");
  std::set<std::string> phases;
  for_each_member<Phases>([&](const auto& phase) { phases.insert(phase.name); });
  EXPECT_EQ(
      error_of(fog + "phase = {type = \"mie\"}\n"),
      fmt::format("fog.toml:5:17: media.0.phase.type = \"mie\" is not known here; accepted: {}",
                  fmt::join(phases, ", ")));
}

TEST(SceneReader, refuses_wrong_types) {
  EXPECT_EQ(error_of("[camera]\nfov = \"wide\"\n"),
            "fog.toml:2:7: camera.fov = \"wide\" is not a number: a number in (0, 180) degrees "
            "(vertical field of view)");
  EXPECT_THAT(error_of("[image]\nwidth = 3.5\n"), HasSubstr("= 3.5 is not a whole number: "));
  EXPECT_THAT(error_of("[camera]\nposition = 3\n"),
              HasSubstr("is not a list of numbers: [x, y, z]"));
  EXPECT_THAT(error_of("[camera]\nposition = [1, 2]\n"), HasSubstr("has 2 numbers, not 3: "));
  EXPECT_THAT(error_of("[camera]\nposition = [1, true, 2]\n"),
              StartsWith("fog.toml:2:16: camera.position.1 = true is not a number: "));
  EXPECT_THAT(error_of("camera = 3\n"), HasSubstr("camera = 3 is not a table"));
  EXPECT_THAT(error_of("lights = 3\n"), HasSubstr("lights = 3 is not a list: a list of tables"));
  EXPECT_THAT(error_of("[camera]\nfov = 2020-01-01\n"), HasSubstr("fov = 2020-01-01 is not"));
  EXPECT_THAT(error_of("[render]\nestimator = 3\n"), HasSubstr("= 3 is not a text: "));
}

TEST(SceneReader, refuses_numbers_without_a_value) {
  EXPECT_EQ(error_of("[camera]\nfov = nan\n"),
            "fog.toml:2:7: camera.fov = nan is not finite: a number in (0, 180) degrees (vertical "
            "field of view)");
  EXPECT_THAT(error_of("background = [1, inf, 1]\n"),
              StartsWith("fog.toml:1:18: background.1 = inf is not finite: "));
  EXPECT_THAT(error_of("[camera]\nposition = [1e19, 0, 0]\n"),
              HasSubstr("camera.position.0 = 1e+19 is out of range, as is all beyond 1e18"));
}

TEST(SceneReader, says_what_is_accepted_where_a_number_is_out_of_range) {
  EXPECT_EQ(error_of(fog + "phase = {type = \"henyey-greenstein\", g = 1.2}\n"),
            "fog.toml:5:42: media.0.phase.g = 1.2 is out of range: a number in (-1, 1) (mean "
            "cosine of the scattering angle; 0 is isotropic, above 0 forward)");
  EXPECT_THAT(error_of(fog + "phase = {type = \"henyey-greenstein\", g = -1}\n"),
              HasSubstr("media.0.phase.g = -1 is out of range: a number in (-1, 1)"));
  EXPECT_EQ(error_of("[image]\nwidth = 0\n"),
            "fog.toml:2:9: image.width = 0 is out of range: a whole number in [1, 65535] pixels "
            "(of the picture)");
  EXPECT_THAT(error_of("[image]\nheight = 65536\n"), HasSubstr("is out of range"));
  EXPECT_THAT(error_of("[render]\nmax_depth = 0\n"),
              StartsWith("fog.toml:2:13: render.max_depth = 0 is out of range: a whole number in "
                         "[1, 65536] (how often light may scatter"));
  EXPECT_THAT(error_of("[render]\nspp = 0\n"), StartsWith("fog.toml:2:7: render.spp = 0 is out"));
  EXPECT_THAT(error_of("[camera]\nfov = 180\n"), HasSubstr("a number in (0, 180) degrees"));
  EXPECT_THAT(error_of("[render]\nsamples_per_ray = 3\n"), HasSubstr("a power of two, or 0"));
}

// --- mistakes: camera, light, medium -------------------------------------------------------------

TEST(SceneReader, refuses_a_camera_that_looks_nowhere) {
  EXPECT_EQ(error_of("[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]\n"),
            "fog.toml:3:10: camera looks nowhere: its target equals its position");
  EXPECT_EQ(error_of("[camera]\nposition = [0, 5, 0]\nup = [0, 2, 0]\n"),
            "fog.toml:3:6: camera looks along its up: give camera.up another direction");
  EXPECT_THAT(error_of("[camera]\nposition = [0, 5, 0]\n"),
              StartsWith("fog.toml:2:12: camera looks along its up"));
  EXPECT_THAT(error_of("[camera]\nup = [0, 0, 0]\n"), HasSubstr("camera.up = [0, 0, 0] is no"));
}

TEST(SceneReader, puts_lights_into_groups) {
  const Scene scene = parse_scene(sun + "group = \"sun\"\n" + sun + sun + "group = \"Lamp_2-b\"",
                                  "fog.toml", {"lights.1.group=sun"});
  EXPECT_EQ(scene.light_groups, (std::vector<std::string>{"sun", "sun", "Lamp_2-b"}));
  EXPECT_EQ(parse_scene(sun, "fog.toml").light_groups, std::vector<std::string>{""});
}

TEST(SceneReader, refuses_groups_that_cannot_be_layers) {
  EXPECT_EQ(error_of(sun + "group = \"key.light\"\n"),
            "fog.toml:5:9: lights.0.group = \"key.light\" is no name of a group: up to 64 letters, "
            "digits, _ and -");
  for (const std::string& name : {std::string(), std::string("größer"), std::string(65, 'a')})
    EXPECT_THAT(error_of(sun + "group = \"" + name + "\"\n"), HasSubstr("is no name of a group"));
  EXPECT_THAT(error_of(sun + "group = 3\n"), HasSubstr("lights.0.group = 3 is not a text"));
  std::vector<std::string> layers = {"ungrouped"};
  for (const Layer& layer : Film({1, 1}, {0, 0, 1, 1}).picture().layers)
    layers.push_back(layer.name);
  EXPECT_GT(layers.size(), 10u);
  for (const std::string& layer : layers)
    EXPECT_THAT(error_of(sun + "group = \"" + layer + "\"\n"),
                HasSubstr("is a layer that every picture has; accepted: all names but albedo, "));
}

TEST(SceneReader, refuses_light_without_one_direction) {
  const std::string light = "[[lights]]\ntype = \"directional\"\nirradiance = 1\n";
  EXPECT_EQ(error_of(light + "direction = [0, 0.0, 0]\n"),
            "fog.toml:4:13: lights.0.direction = [0, 0, 0] is no direction: at least one number "
            "must not be 0");
  const std::string accepted = "accepted: direction, or azimuth and elevation";
  EXPECT_EQ(error_of(light), "fog.toml:1:1: lights.0 lacks direction, or azimuth and elevation");
  EXPECT_EQ(error_of(light + "azimuth = 3\n"),
            "fog.toml:4:11: lights.0 has azimuth without elevation; " + accepted);
  EXPECT_EQ(error_of(light + "direction = [1, 0, 0]\nelevation = 3\n"),
            "fog.toml:4:13: lights.0 has direction and elevation; " + accepted);
  EXPECT_THAT(error_of(light + "direction = [1, 0, 0]\nangular_diameter = 90\n"),
              HasSubstr("a number in [0, 90) degrees"));
}

TEST(SceneReader, refuses_other_pairs_of_coefficients) {
  const std::string ways = "sigma_s and sigma_a, or albedo and sigma_t, or albedo and visibility";
  const std::string accepted = "; accepted: " + ways;
  const auto error_with = [](const std::string& keys) {
    return error_of("[[media]]\nshape = {type = \"box\"}\n" + keys);
  };
  EXPECT_EQ(error_with(""), "fog.toml:1:1: media.0 lacks " + ways);
  EXPECT_EQ(error_with("sigma_s = 1\n"),
            "fog.toml:3:11: media.0 has sigma_s without sigma_a" + accepted);
  EXPECT_EQ(error_with("sigma_s = 1\nsigma_t = 2\n"),
            "fog.toml:3:11: media.0 has sigma_s and sigma_t" + accepted);
  EXPECT_EQ(error_with("sigma_s = 1\nsigma_a = 1\nsigma_t = 2\n"),
            "fog.toml:3:11: media.0 has sigma_s and sigma_a and sigma_t" + accepted);
  EXPECT_THAT(error_with("sigma_s = -0.1\nsigma_a = 1\n"),
              StartsWith("fog.toml:3:11: media.0.sigma_s = -0.1 is out of range: "));
  EXPECT_THAT(error_with("sigma_s = [0.1, -1, 1]\nsigma_a = 1\n"),
              StartsWith("fog.toml:3:17: media.0.sigma_s.1 = -1 is out of range: "));
  EXPECT_THAT(error_with("albedo = 1.01\nsigma_t = 1\n"), HasSubstr("each in [0, 1]"));
  EXPECT_THAT(error_with("albedo = 1\nvisibility = 0\n"), HasSubstr("visibility = 0 is out of"));
}

/// A box of fog from x = low to x = high.
std::string fog_between(double low, double high) {
  return fmt::format(
      "[[media]]\nsigma_s = 0.1\nsigma_a = 0\n"
      "shape = {{type = \"box\", min = [{}, 0, 0], max = [{}, 1, 1]}}\n",
      low, high);
}

TEST(SceneReader, takes_media_side_by_side) {
  const Scene scene = parse_scene(fog_between(0, 1) + fog_between(1, 2), "fog.toml");
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(std::get<Box>(scene.media[1].shape).max.x, 2);
  // What touches but for rounding touches.
  EXPECT_EQ(error_of(fog_between(0, 0.1 + 0.2) + fog_between(0.3, 1)), "");
}

TEST(SceneReader, refuses_media_that_do_not_fit_side_by_side) {
  EXPECT_EQ(error_of(fog_between(0, 1) + fog_between(2, 3) + fog_between(0.9, 2)),
            "fog.toml:1:1: media hold two that overlap, media.0 and media.2; accepted: media that "
            "touch at most");
  std::string many, faces;
  for (int i = 0; i < 17; ++i) many += fog_between(i, i + 1);
  EXPECT_THAT(error_of(many), HasSubstr("media are 17; accepted: up to 16 side by side"));
  const std::string endless =
      "[[media]]\nsigma_s = 1\nsigma_a = 0\nshape = {type = \"unbounded\"}\n";
  EXPECT_THAT(error_of(fog_between(0, 1) + endless),
              HasSubstr("media cannot lie side by side, as media.1 is of type unbounded; accepted: "
                        "several of type box or convex, or one alone of any type"));
}

/// A file with triangles over the unit cube's corners, and a scene with fog inside it.
struct MeshOfFog {
  test::Folder folder;

  explicit MeshOfFog(const std::string& faces) {
    std::string corners;
    for (int i = 0; i < 8; ++i)
      corners += fmt::format("v {} {} {}\n", i & 1, (i >> 1) & 1, (i >> 2) & 1);
    std::ofstream(folder.path() / "fog.obj") << corners << faces;
  }

  std::string scene() const { return (folder.path() / "fog.toml").string(); }
  Scene load(const std::string& keys = "") const {
    return parse_scene(
        "[[media]]\nsigma_s = 1\nsigma_a = 0\nshape = {type = \"mesh\", file = "
        "\"fog.obj\"" +
            keys + "}\n",
        scene());
  }
};

constexpr const char* cube = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

TEST(SceneReader, takes_a_medium_inside_a_mesh) {
  const Scene scene = MeshOfFog(cube).load(", scale = 2, translate = [0, 0, 5]");
  const ClosedMesh& mesh = *std::get<Solid>(scene.media.at(0).shape).mesh;
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.centre, (ClosedMesh::Point{1, 1, 6}));
}

TEST(SceneReader, refuses_a_medium_inside_a_mesh_that_closes_off_nothing) {
  const auto error_with = [](const std::string& faces) -> std::string {
    const MeshOfFog fog(faces);
    try {
      fog.load();
    } catch (const Error& error) {
      return std::string(error.what()).substr(fog.scene().size());
    }
    return "";
  };
  EXPECT_EQ(error_with(cube), "");
  EXPECT_EQ(error_with("f 1 3 4 2\n"),
            ":4:32: media.0.shape.file = \"fog.obj\" is no closed body: its edge from [0, 0, 0] to "
            "[0, 1, 0] belongs to 1 triangle; accepted: 2 at every edge");
  EXPECT_THAT(error_with(""), HasSubstr("media.0.shape.file"));
}

TEST(SceneReader, asks_for_the_shape_of_a_medium) {
  EXPECT_THAT(error_of("[[media]]\nalbedo = 1\nsigma_t = 1\n"),
              StartsWith("fog.toml:1:1: media.0.shape is missing; a table with a type: box, "));
}

TEST(SceneReader, refuses_an_empty_or_inverted_box) {
  const auto error_with = [](const std::string& max) {
    return error_of("[[media]]\nalbedo = 1\nsigma_t = 1\nshape = {type = \"box\", max = " + max +
                    "}\n");
  };
  EXPECT_EQ(
      error_with("[1, -1, 1]"),
      "fog.toml:4:30: media.0.shape is an empty box: max equals min in y (-1 and -1); max must "
      "lie above min in x, y and z");
  EXPECT_THAT(error_with("[1, 1, -2]"),
              HasSubstr("is an inverted box: max lies below min in z (-2 and -1)"));
}

TEST(SceneReader, refuses_directional_light_in_an_endless_medium) {
  const std::string endless =
      "[[media]]\nsigma_s = 1\nsigma_a = 0\nshape = {type = \"unbounded\"}\n";
  EXPECT_EQ(error_of(endless), "");
  EXPECT_EQ(error_of(endless + sun),
            "fog.toml:4:9: media.0.shape does not fit the lights: a directional light never "
            "arrives in an unbounded medium, as all of it is lost on its way from infinitely far; "
            "give the medium a shape with an end, or leave out the light");
}

// --- overrides -----------------------------------------------------------------------------------

TEST(Overrides, change_any_value_by_its_path) {
  const Scene scene = parse_scene("camera.position = [1, 2, 3]\n" + fog +
                                      "phase = {type = \"henyey-greenstein\", g = 0.1}\n" + sun,
                                  "fog.toml",
                                  {"lights.0.irradiance=[1, 2, 3]", "media.0.phase.g = .5",
                                   "render.spp=64", "camera.position.1=7", "render.filter=box",
                                   "render.estimator=distance+ratio", "media.0.sigma_a=0"});
  EXPECT_EQ(std::get<Directional>(scene.lights[0]).irradiance, Rgb<double>(1, 2, 3));
  EXPECT_EQ(std::get<HenyeyGreenstein>(scene.media[0].phase).g, 0.5);
  EXPECT_EQ(scene.render.spp, 64);
  EXPECT_EQ(scene.render.filter, PixelFilter::box);
  EXPECT_EQ(scene.render.estimator, "distance+ratio");
  EXPECT_EQ(scene.media[0].sigma_t, scene.media[0].sigma_s);
}

TEST(Overrides, are_named_in_errors) {
  EXPECT_EQ(error_of(sun, {"lights.0.irradiance=abc"}),
            "-D lights.0.irradiance=abc: lights.0.irradiance = \"abc\" is not a number: a number "
            "or [r, g, b], each of at least 0 W/m2 (on a surface that faces the light, outside the "
            "medium)");
  EXPECT_EQ(error_of(sun, {"lights.0.iradiance=3"}),
            "-D lights.0.iradiance=3: lights.0.iradiance is not known here; accepted: "
            "angular_diameter, azimuth, direction, elevation, group, irradiance, type");
  EXPECT_EQ(error_of(sun, {"lights.1.irradiance=3"}),
            "-D lights.1.irradiance=3: lights.1 is not there; lights is a list of 1, counted from "
            "0");
  EXPECT_EQ(error_of(sun, {"lights.sun.irradiance=3"}),
            "-D lights.sun.irradiance=3: lights.sun is not there; lights is a list of 1, counted "
            "from 0");
  EXPECT_EQ(error_of(sun, {"lights.0.irradiance.r=3"}),
            "-D lights.0.irradiance.r=3: lights.0.irradiance.r is not there; lights.0.irradiance "
            "= 2 has no parts");
  EXPECT_THAT(error_of(sun, {"lights.0.direction=[1, 2"}),
              StartsWith("-D lights.0.direction=[1, 2: the value is not TOML: "));
  for (const char* nothing : {"render.spp=", "x=", "lights.0.irradiance =  "})
    EXPECT_EQ(error_of(sun, {nothing}),
              std::string("-D ") + nothing +
                  ": the value is missing; accepted: one as a scene file says it, such as 3, "
                  "[1, 2, 3] or rewv, and \"\" for an empty text");
  EXPECT_THAT(error_of(sun, {"render.spp=0"}),
              StartsWith("-D render.spp=0: render.spp = 0 is out"));
  EXPECT_THAT(error_of(sun, {{"render.spp", "0", "--spp 0"}}), StartsWith("--spp 0: render.spp"));
  EXPECT_THAT(error_of(sun, {"lights..x=0"}), HasSubstr("a key is empty"));
}

TEST(Overrides, replace_a_way_to_say_something_by_another) {
  const std::string by_sky = R"([[lights]]
type = "directional"
irradiance = 2
azimuth = 0
elevation = 30
)";
  const auto direction = [&](const std::string& text, const std::vector<Override>& changes) {
    return std::get<Directional>(parse_scene(text, "fog.toml", changes).lights.at(0)).direction;
  };
  expect_near(direction(by_sky, {"lights.0.direction=[0, 3, 4]"}), {0, 0.6, 0.8});
  expect_near(direction(sun, {"lights.0.azimuth=90", "lights.0.elevation=0"}), {-1, 0, 0});
  const auto sigma_t = [](const std::string& keys, const std::vector<Override>& changes) {
    return parse_scene("[[media]]\nshape = {type = \"box\"}\n" + keys, "fog.toml", changes)
        .media[0]
        .sigma_t.g;
  };
  EXPECT_DOUBLE_EQ(sigma_t("albedo = 1\nsigma_t = 2\n", {"media.0.visibility=39.12"}), 0.1);
  EXPECT_DOUBLE_EQ(sigma_t("albedo = 1\nvisibility = 2\n", {"media.0.sigma_t=3"}), 3);
  EXPECT_DOUBLE_EQ(sigma_t("sigma_s = 1\nsigma_a = 2\n", {"media.0.sigma_t=4", "media.0.albedo=1"}),
                   4);
  const Scene scene =
      parse_scene(fog + "phase = {type = \"henyey-greenstein\", g = 0.1}\n", "fog.toml",
                  {"media.0.phase.type=isotropic", "media.0.shape.type=convex",
                   "media.0.shape.points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]"});
  EXPECT_TRUE(std::holds_alternative<Isotropic>(scene.media[0].phase));
  EXPECT_EQ(std::get<Convex>(scene.media[0].shape).face_count, 4);
}

TEST(Overrides, are_the_place_of_errors_that_come_of_them) {
  EXPECT_THAT(error_of(sun, {"lights.0.azimuth=3"}),
              StartsWith("-D lights.0.azimuth=3: lights.0 has azimuth without elevation; "));
  EXPECT_THAT(error_of(sun, {"lights.0.azimuth=3", "lights.0.direction=[0, 1, 0]"}),
              StartsWith("-D lights.0.direction=[0, 1, 0]: lights.0 has direction and azimuth; "));
  EXPECT_THAT(error_of(fog, {"media.0.visibility=30"}),
              StartsWith("-D media.0.visibility=30: media.0 has visibility without albedo; "));
  EXPECT_THAT(error_of(fog, {"media.0.shape.min=[0, 2, 0]"}),
              StartsWith("-D media.0.shape.min=[0, 2, 0]: media.0.shape is an inverted box"));
  EXPECT_THAT(error_of(fog, {"media.0.shape.min.1=2"}), StartsWith("-D media.0.shape.min.1=2: "));
  EXPECT_THAT(error_of(fog, {"media.0.shape.type=convex"}),
              StartsWith("-D media.0.shape.type=convex: media.0.shape lacks planes, or points"));
  EXPECT_THAT(
      error_of(fog + sun, {"media.0.shape.type=unbounded"}),
      StartsWith("-D media.0.shape.type=unbounded: media.0.shape does not fit the lights: "));
  EXPECT_THAT(error_of("[camera]\ntarget = [1, 2, 3]\n", {"camera.position=[1, 2, 3]"}),
              StartsWith("-D camera.position=[1, 2, 3]: camera looks nowhere"));
  EXPECT_THAT(error_of("[camera]\nup = [0, 1, 0]\n", {"camera.position=[0, 5, 0]"}),
              StartsWith("-D camera.position=[0, 5, 0]: camera looks along its up"));
  EXPECT_EQ(error_of(fog + sun, {"lights.0.irradiance=1e999"}),
            "-D lights.0.irradiance=1e999: the number is too large or too small to be held");
  // What is wrong in the file stays the file's.
  EXPECT_THAT(error_of(fog + "colour = 1\n", {"media.0.phase.type=isotropic"}),
              StartsWith("fog.toml:5:1: media.0.colour is not known here"));
  EXPECT_THAT(
      error_of(fog + "phase = {type = \"isotropic\", f = 1}\n", {"media.0.phase.type=rayleigh"}),
      StartsWith("fog.toml:5:30: media.0.phase.f is not known here"));
}

TEST(Overrides, must_be_assignments) {
  for (const char* text : {"", "=3", "render.spp"})
    EXPECT_THROW(Override{text}, Error) << '"' << text << '"';
}

}  // namespace airlight
