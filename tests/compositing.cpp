// Pictures laid over pictures: backgrounds, holdouts, alpha and depth images, in every arithmetic
// and through the program.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <png.h>

#include <random>

#include "error.h"
#include "image/decoders.h"
#include "image/input.h"
#include "image/output.h"
#include "image/read_file.h"
#include "image/resize.h"
#include "image/srgb.h"
#include "render/kernel.h"
#include "render/prepare.h"
#include "render/render.h"
#include "scene/described.h"
#include "scene/load_scene.h"
#include "scene/objects.h"
#include "scene/objects/depth_surface.h"
#include "support/program.h"

namespace airlight {
namespace {

using test::Folder;
using ::testing::HasSubstr;
using Colour = Rgb<double>;

const Mesh& mesh_of(const Scene& scene) { return std::get<Mesh>(scene.objects.at(0).geometry); }

/// A picture without two pixels alike.
Image noise(int width, int height) {
  Image image(width, height);
  std::mt19937 random(7);
  for (float& value : image.pixels) value = std::uniform_real_distribution<float>(0.1f, 2)(random);
  return image;
}

Image product(Image a, const Image& b) {
  std::ranges::transform(a.pixels, b.pixels, a.pixels.begin(), std::multiplies());
  return a;
}

/// Fog between -1 and 1 in front of everything, a ball, a pane of blue glass and a wall behind half
/// of the picture.
Scene veiled(int width, int height) {
  Scene scene = parse_scene(R"(
[camera]
position = [0, 0, 4]
[[media]]
sigma_s = [0.3, 0.4, 0.5]
sigma_a = 0.1
shape = {type = "box", min = [-3, -3, -1], max = [3, 3, 1]}
[[lights]]
type = "directional"
irradiance = 3
direction = [-1, -2, -0.5]
[[objects]]
type = "sphere"
centre = [-0.5, 0.2, 0]
radius = 0.6
[[objects]]
type = "rectangle"
corner = [0, -0.5, 1.5]
u = [0.8, 0, 0]
v = [0, 1, 0]
opacity = 0.25
tint = [0.2, 0.5, 0.9]
albedo = [0.9, 0.2, 0.1]
[[objects]]
type = "rectangle"
corner = [-4, -4, -2]
u = [4, 0, 0]
v = [0, 8, 0]
)",
                            "veiled");
  scene.resolution = {width, height};
  scene.render.spp = 8;
  scene.render.samples_per_ray = 2;
  return scene;
}

class EveryArithmetic : public testing::TestWithParam<const Kernel*> {
 protected:
  Film render(Scene scene, const RenderControl& control = {}) const {
    scene.render.isa = GetParam()->isa;
    const Rendered rendered = Renderer(scene).render(scene.render, control);
    EXPECT_EQ(rendered.rejected, 0);
    return rendered.film;
  }

  /// Relative error of a pixel's sum of some products; a film keeps floats.
  float rounding() const { return GetParam()->isa == InstructionSet::reference ? 4e-7f : 2e-6f; }

  void expect_equal(const Image& got, const Image& want) const {
    ASSERT_EQ(got.pixels.size(), want.pixels.size());
    float worst = 0;
    for (std::size_t i = 0; i < got.pixels.size(); ++i)
      worst = std::max(worst, std::abs(got.pixels[i] - want.pixels[i]) / (want.pixels[i] + 0.1f));
    EXPECT_LT(worst, rounding());
  }
};

INSTANTIATE_TEST_SUITE_P(Compositing, EveryArithmetic, testing::ValuesIn(available_kernels()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST_P(EveryArithmetic, a_background_is_seen_pixel_by_pixel) {
  Scene scene;
  scene.resolution = {21, 9};
  scene.background_image = noise(21, 9);
  scene.render.spp = 8, scene.render.samples_per_ray = 1;  // the filter must not blur it
  expect_equal(render(scene).layer("beauty"), scene.background_image);
}

TEST_P(EveryArithmetic, a_crop_sees_its_part_of_the_background) {
  Scene scene;
  scene.resolution = {40, 30};
  scene.background_image = noise(40, 30);
  RenderControl control;
  control.crop = PixelRect{17, 11, 20, 19};
  const Image beauty = render(scene, control).layer("beauty");
  Image want(20, 19);
  for (int y = 0; y < 19; ++y)
    std::ranges::copy(scene.background_image.row(11 + y).subspan(17 * 3, 20 * 3),
                      want.row(y).begin());
  expect_equal(beauty, want);
}

TEST_P(EveryArithmetic, layers_laid_over_a_picture_are_what_is_rendered_before_it) {
  for (bool holdout : {false, true}) {
    Scene scene = veiled(48, 40);
    scene.objects[0].holdout = holdout;
    const Film alone = render(scene);
    const Image in_scatter = alone.layer("in_scatter"), surface = alone.layer("surface");
    Image passes = alone.layer("transmittance");
    if (holdout) passes = product(passes, alone.layer("shadow"));
    scene.background_image = noise(48, 40);
    Image composite = product(passes, scene.background_image);
    for (std::size_t i = 0; i < composite.pixels.size(); ++i)
      composite.pixels[i] += in_scatter.pixels[i] + surface.pixels[i];
    expect_equal(render(scene).layer("beauty"), composite);
  }
}

/// The camera's view of a holdout.
TEST_P(EveryArithmetic, a_holdout_shows_the_background_behind_the_fog_before_it) {
  Scene scene = parse_scene(R"(
background = [1, 2, 3]
ambient = 5
[camera]
position = [0, 0, 4]
fov = 1
[image]
width = 4
height = 4
[[media]]
albedo = 0
sigma_t = [0.1, 0.5, 1]
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[objects]]
type = "sphere"
radius = 0.5
holdout = true
)",
                            "holdout");
  const Film film = render(scene);
  const Image beauty = film.layer("beauty"), depth = film.layer("depth");
  // The nearest point of the sphere has half a metre of fog before it.
  for (int c = 0; c < 3; ++c) {
    const double want = (c + 1) * std::exp(-0.5 * std::array{0.1, 0.5, 1.}[std::size_t(c)]);
    EXPECT_NEAR(beauty.at(2, 2, c), want, 1e-3 * want);
  }
  EXPECT_NEAR(depth.at(2, 2, 0), 3.5, 1e-3);
}

TEST_P(EveryArithmetic, a_cut_out_holdout_hides_what_is_behind_it_as_far_as_it_is_opaque) {
  Scene scene = parse_scene(R"(
background = 1
ambient = 1
[camera]
position = [0, 0, 4]
fov = 1
[image]
width = 1
height = 1
[[objects]]
type = "rectangle"
corner = [-1, -1, 0]
u = [2, 0, 0]
v = [0, 2, 0]
opacity = 0.25
tint = [1, 0.5, 0]
albedo = 1
holdout = true
[[objects]]
type = "rectangle"
corner = [-1, -1, -1]
u = [2, 0, 0]
v = [0, 2, 0]
albedo = [0.2, 0.4, 0.6]
)",
                            "holdout");
  const Film film = render(scene);
  const Image beauty = film.layer("beauty"), transmittance = film.layer("transmittance");
  const float wall[3] = {0.75f * 0.2f, 0.75f * 0.5f * 0.4f, 0};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(beauty.at(0, 0, c), 0.25f + wall[c], 1e-6f);
    EXPECT_NEAR(transmittance.at(0, 0, c), 0.25f, 1e-6f);
  }
}

TEST_P(EveryArithmetic, a_holdout_shadows_the_fog_as_any_object_does) {
  Scene scene = veiled(32, 24);
  const Image want = render(scene).layer("in_scatter");
  for (Object& object : scene.objects) object.holdout = true;
  EXPECT_EQ(render(scene).layer("in_scatter").pixels, want.pixels);
}

// ---- shadows on holdouts

/// A floor that the picture shows, seen from the side under a sun at the zenith. What throws a
/// shadow is not in view; it is above the origin, at which the camera looks.
Scene floor_with(const std::string& more, const std::vector<Override>& changes = {}) {
  return parse_scene(R"(
background = [1, 2, 3]
ambient = [0.1, 0.3, 0.7]
[camera]
position = [0, 0.5, 3]
target = [0, 0, 0]
fov = 1
[image]
width = 5
height = 3
[render]
spp = 8
samples_per_ray = 2
[[lights]]
type = "directional"
irradiance = [3, 2, 1]
direction = [0, -1, 0]
[[objects]]
type = "rectangle"
corner = [-9, 0, 9]
u = [18, 0, 0]
v = [0, 0, -18]
holdout = true
)" + more,
                     "floor", changes);
}

constexpr const char* ball = R"(
[[objects]]
type = "sphere"
centre = [0, 2, 0]
radius = 0.5
)";

/// What is left of the light on that floor if so much of the sun arrives.
Colour left(const Colour& sun) {
  const Colour ambient = Colour(0.1, 0.3, 0.7) * pi, all(3, 2, 1);
  Colour result;
  for (int c = 0; c < 3; ++c) result[c] = (ambient[c] + all[c] * sun[c]) / (ambient[c] + all[c]);
  return result;
}

class ShadowOnHoldouts : public EveryArithmetic {
 protected:
  /// The picture is its background times this, however the rays are answered and followed.
  void expect_left(Scene scene, const Colour& want, double tolerance = 2e-6) const {
    for (const Visibility visibility : {Visibility::embree, Visibility::analytic})
      for (const int max_depth : {1, 4}) {
        scene.render.visibility = visibility;
        scene.render.max_depth = max_depth;
        const Film film = render(scene);
        const auto expect_near = [&](const Image& image, double times) {
          for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double unit = 1 + times * double(i % 3);
            ASSERT_NEAR(image.pixels[i], unit * want[int(i % 3)], unit * tolerance) << i;
          }
        };
        expect_near(film.layer("beauty"), 1);
        if (film.layout.shadow) expect_near(film.layer("shadow"), 0);
      }
  }
};

INSTANTIATE_TEST_SUITE_P(Compositing, ShadowOnHoldouts, testing::ValuesIn(available_kernels()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST_P(ShadowOnHoldouts, leaves_the_ambient_light_in_the_umbra) {
  expect_left(floor_with(ball), left(Colour()));
}

TEST_P(ShadowOnHoldouts, is_none_beside_what_throws_it) {
  expect_left(floor_with(ball, {"objects.1.centre=[0.7, 2, 0]"}), Colour(1.), 0);
}

TEST_P(ShadowOnHoldouts, of_holdouts_is_in_the_picture_already) {
  expect_left(floor_with(ball, {"objects.1.holdout=true"}), Colour(1.), 0);
  // Where a holdout keeps the sun out, nothing else can take it.
  expect_left(floor_with(ball + std::string(ball), {"objects.1.holdout=true"}), Colour(1.), 0);
}

TEST_P(ShadowOnHoldouts, of_glass_is_tinted) {
  const Scene scene = floor_with(R"(
[[objects]]
type = "rectangle"
corner = [-1, 2, 1]
u = [2, 0, 0]
v = [0, 0, -2]
opacity = 0.25
tint = [1, 0.5, 0]
)");
  expect_left(scene, left(Colour(0.75, 0.375, 0)));
}

TEST_P(ShadowOnHoldouts, of_fog_is_what_it_takes_of_the_light) {
  // A metre of it between the sun and the floor, none before the camera.
  const std::string fog = R"(
[[media]]
albedo = 0
sigma_t = [0.1, 0.5, 2]
shape = {type = "box", min = [-9, 1, -9], max = [9, 2, 9]}
)";
  const Colour arrives(std::exp(-0.1), std::exp(-0.5), std::exp(-2.));
  expect_left(floor_with(fog), left(arrives));
  expect_left(floor_with(fog + ball, {"objects.1.centre=[0, 4, 0]"}), left(Colour()));
}

TEST_P(ShadowOnHoldouts, is_none_where_there_is_no_light) {
  expect_left(floor_with(ball, {"ambient=0", "lights.0.direction=[0, 1, 0]"}), Colour(1.), 0);
  expect_left(floor_with(ball, {"ambient=0", "lights.0.irradiance=0"}), Colour(1.), 0);
}

TEST_P(ShadowOnHoldouts, is_a_ratio_of_sums) {
  // A wall's edge above the origin hides half of the sun's disc from what is below it. The samples
  // of a pixel are jittered strata of the disc; their number bounds the error of each.
  Scene scene = floor_with(R"(
[[objects]]
type = "rectangle"
corner = [-9, 2, 0]
u = [18, 0, 0]
v = [0, 0, -9]
)",
                           {"lights.0.angular_diameter=8", "camera.fov=0.001", "render.spp=1024",
                            "render.samples_per_ray=1", "render.visibility=analytic"});
  const Film film = render(scene);
  const Image beauty = film.layer("beauty");
  const Colour want = left(Colour(0.5));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(beauty.at(2, 1, c), (c + 1) * want[c], 0.01 * (c + 1));
}

TEST_P(ShadowOnHoldouts, dims_as_much_of_a_pixel_as_shows_them) {
  // The floor is a thin veil: what is behind it passes and knows no shadow.
  Scene scene = floor_with(ball, {"objects.0.opacity=0.25", "objects.0.tint=[1, 0.5, 0]"});
  const Film film = render(scene);
  const Image beauty = film.layer("beauty"), shadow = film.layer("shadow"),
              transmittance = film.layer("transmittance");
  const Colour through(0.75, 0.375, 0);
  for (int c = 0; c < 3; ++c) {
    const double want = 0.25 * left(Colour())[c] + through[c];
    EXPECT_NEAR(beauty.at(2, 1, c), (c + 1) * want, 4e-6);
    EXPECT_NEAR(transmittance.at(2, 1, c), 0.25 + through[c], 1e-6);
    EXPECT_NEAR(shadow.at(2, 1, c), want / (0.25 + through[c]), 2e-6);
  }
}

TEST_P(ShadowOnHoldouts, of_ranges_of_samples_adds_up) {
  const std::string fog = R"(
[[media]]
albedo = 0.9
sigma_t = [0.1, 0.5, 2]
shape = {type = "box", min = [-9, 0, -9], max = [9, 4, 9]}
)";
  const std::vector<Override> changes = {"camera.fov=25", "lights.0.angular_diameter=8",
                                         "image.width=21", "image.height=11"};
  for (const int max_depth : {1, 3}) {
    Scene scene = floor_with(ball + fog, changes);
    scene.render.max_depth = max_depth;
    scene.render.spp = 16, scene.render.samples_per_ray = 1, scene.render.first_sample = 0;
    const Film whole = render(scene);
    scene.render.spp = 8;
    Film sum = render(scene);
    scene.render.first_sample = 8;
    sum.merge(render(scene));
    for (const char* layer : {"beauty", "shadow"})
      expect_equal(sum.layer(layer), whole.layer(layer));
    const Image shadow = whole.layer("shadow");
    EXPECT_LT(std::ranges::min(shadow.pixels), 0.6f);
    EXPECT_LE(std::ranges::max(shadow.pixels), 1.f);
  }
}

TEST(Shadow, costs_memory_only_where_there_can_be_one) {
  const auto layout = [](const Scene& scene) {
    return film_layout(scene, estimator_for(scene.render));
  };
  const std::size_t with = layout(floor_with(ball)).bytes_a_pixel();
  for (const Scene& scene : {floor_with(""), floor_with(ball, {"objects.0.holdout=false"}),
                             floor_with(ball, {"lights=[]"})}) {
    EXPECT_FALSE(layout(scene).shadow);
    EXPECT_EQ(layout(scene).bytes_a_pixel(), with - 3 * sizeof(double) - 9 * sizeof(float));
  }
}

/// A row of pixels of the beauty, four numbers each, the last one alpha.
Picture with_alpha(const Image& rgba) {
  Picture picture;
  picture.width = rgba.width, picture.height = rgba.height;
  const auto channels = [&rgba](int first, int count) {
    return [&rgba, first, count](int y, std::span<float> row) {
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = rgba.at(int(i) / count, y, first + int(i) % count);
    };
  };
  picture.layers = {{"beauty", {"R", "G", "B"}, channels(0, 3)}};
  picture.alpha = {"alpha", {"A"}, channels(3, 1)};
  return picture;
}

Codes codes_of(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return decode_codes({bytes, path});
}

TEST(Alpha, of_a_png_lays_light_over_a_photograph) {
  const Folder folder;
  // Opaque, half covered, light added to nearly all of the background, nothing at all.
  Image pixels(4, 1, 4);
  pixels.pixels = {0.2f, 0.5f, 1, 1, 0.1f, 0.2f, 0.3f, 0.5f, 0.4f, 0.2f, 0.1f, 0.05f, 0, 0, 0, 0};
  write_png(folder / "layer.png", with_alpha(pixels));
  const Codes codes = codes_of(folder / "layer.png");
  for (int x = 0; x < 4; ++x) {
    const std::uint8_t* code = &codes.rgba[std::size_t(4 * x)];
    const float alpha = float(code[3]) / 255;
    // Alpha is as it was, or as bright as the light that it must hold.
    const float brightest = *std::max_element(&pixels.pixels[std::size_t(4 * x)],
                                              &pixels.pixels[std::size_t(4 * x)] + 3);
    EXPECT_NEAR(alpha, std::max(pixels.at(x, 0, 3), brightest), 1 / 255.f) << x;
    for (int c = 0; c < 3; ++c) {
      // Half a code of colour, 0.9 % of light at most, and its share of alpha.
      EXPECT_NEAR(linear_of_srgb[code[c]] * alpha, pixels.at(x, 0, c), 0.005f * alpha + 1e-6f)
          << x << ", " << c;
    }
  }
}

TEST(Alpha, covers_what_transmittance_leaves) {
  const Folder folder;
  test::write_bytes(folder / "scene.toml", R"(
background = 3
[camera]
position = [0, 0, 4]
[image]
width = 40
height = 30
[render]
spp = 16
samples_per_ray = 2
[[media]]
sigma_s = [0.1, 0.2, 0.3]
sigma_a = 0
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[lights]]
type = "directional"
irradiance = 3
direction = [-1, -2, -0.5]
[[objects]]
type = "sphere"
radius = 0.5
)");
  const auto outcome = test::run({"render", folder / "scene.toml", "--alpha", "--exr", "float",
                                  "-o", folder / "layer.exr", "-o", folder / "layer.png"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Image alpha = read_numbers(folder / "layer.exr", "A").image;
  const Image beauty = read_image(folder / "layer.exr"),
              through = read_image(folder / "layer.exr", "transmittance"),
              scattered = read_image(folder / "layer.exr", "in_scatter");
  ASSERT_EQ(alpha.pixels.size(), 1200u);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const float mean = (through.at(x, y, 0) + through.at(x, y, 1) + through.at(x, y, 2)) / 3;
      EXPECT_NEAR(alpha.at(x, y, 0), 1 - mean, 1e-6f);
    }
  EXPECT_EQ(alpha.at(20, 15, 0), 1);     // the ball
  EXPECT_EQ(alpha.at(0, 0, 0), 0);       // beside the fog
  EXPECT_EQ(beauty.at(0, 0, 0), 0);      // without the background
  const float fog = alpha.at(20, 7, 0);  // 2.03 m of it
  EXPECT_NEAR(fog, 1 - (std::exp(-0.203f) + std::exp(-0.406f) + std::exp(-0.61f)) / 3, 0.005f);
  EXPECT_EQ(beauty.at(20, 7, 1), scattered.at(20, 7, 1));
}

TEST(Alpha, of_a_shadow_is_the_light_it_takes) {
  const Folder folder;
  Scene scene = floor_with(ball);
  scene.background_image = Image(5, 3);
  Picture picture;
  const Rendered done = Renderer(scene).render(scene.render);
  picture = done.film.picture();
  add_alpha(picture);
  std::vector<float> row(5);
  picture.alpha->fill(1, row);
  const Colour rest = left(Colour());
  for (const float alpha : row) EXPECT_NEAR(alpha, 1 - (rest.r + rest.g + rest.b) / 3, 2e-6);
  // Nothing but shadow is in the layer: it darkens what it is laid over.
  for (const float light : done.film.layer("beauty").pixels) EXPECT_EQ(light, 0);
}

TEST(Holdouts, are_objects_of_every_kind) {
  for_each_member<Objects>([](auto object) {
    object.holdout = true;
    Parts parts = single_part(Sphere());
    object.place(parts, object.name);
    EXPECT_TRUE(parts.objects[0].holdout) << object.name;
  });
  const Scene scene = parse_scene("[[objects]]\ntype = \"tree\"\nholdout = true\n", "tree");
  EXPECT_GT(scene.objects.size(), 1u);
  for (const Object& object : scene.objects) EXPECT_TRUE(object.holdout) << object.name;
}

TEST(Backgrounds, come_from_the_scene_or_the_command_line) {
  const Folder folder;
  Image plate = noise(8, 6);
  write_pfm(folder / "a plate's \"own\" name.pfm", picture_of(plate));
  test::write_bytes(folder / "scene.toml",
                    "background_image = '''a plate's \"own\" name.pfm'''\nbackground = 7\n"
                    "[image]\nwidth = 8\nheight = 6\n");
  EXPECT_EQ(load_scene(folder / "scene.toml").background_image.pixels, plate.pixels);
  test::write_bytes(folder / "plain.toml", "background = 7\n[image]\nwidth = 8\nheight = 6\n");
  const auto outcome = test::run({"render", folder / "plain.toml", "--background",
                                  folder / "a plate's \"own\" name.pfm", "-o", folder / "out.pfm"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(read_image(folder / "out.pfm").pixels, plate.pixels);
}

TEST(Backgrounds, of_another_size_are_brought_to_that_of_the_render) {
  const Folder folder;
  const Image plate = noise(8, 6);
  write_pfm(folder / "plate.pfm", picture_of(plate));
  test::write_bytes(folder / "scene.toml", "background_image = \"plate.pfm\"\n");
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += double(value);
    return sum / double(image.pixels.size());
  };
  const auto [least, most] = std::ranges::minmax(plate.pixels);
  for (const char* size : {"4x3", "16x12", "40x30", "800x600"}) {
    SCOPED_TRACE(size);
    const auto outcome = test::run(
        {"render", folder / "scene.toml", "--size", size, "--spp", "1", "-o", folder / "out.pfm"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr((folder / "plate.pfm").string() + " is 8 x 6 pixels and is shown at "));
    const Image shown = read_image(folder / "out.pfm");
    // What lies at the edge counts a little more or less.
    EXPECT_NEAR(mean(shown), mean(plate), 0.05 * mean(plate));
    EXPECT_GE(std::ranges::min(shown.pixels), least);
    EXPECT_LE(std::ranges::max(shown.pixels), most);
  }
  // Pixels that are alike stay as they are.
  Image grey(4, 2);
  std::ranges::fill(grey.pixels, 0.3f);
  for (const float value : resized(grey, 10, 5).pixels) EXPECT_FLOAT_EQ(value, 0.3f);
}

TEST(Backgrounds, and_files_that_a_flag_names_start_at_the_current_folder) {
  const Folder folder;
  std::filesystem::create_directory(folder / "scenes");
  std::filesystem::create_directory(folder / "shots");
  for (const char* name : {"scenes/plate.pfm", "shots/plate.pfm"})
    write_pfm(folder / name, picture_of(Image(8, name[1] == 'c' ? 6 : 3)));
  test::write_bytes(folder / "scenes/scene.toml", R"(
background_image = "plate.pfm"
[image]
width = 8
height = 6
[[objects]]
type = "mesh"
file = "part.obj"
)");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  test::write_bytes(folder / "scenes/part.obj", triangle);
  test::write_bytes(folder / "shots/part.obj", triangle + "f 3 2 1\n");
  const auto triangles = [&](const std::vector<Override>& changes) {
    return mesh_of(load_scene("../scenes/scene.toml", changes)).triangles.size();
  };
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "shots");
  EXPECT_EQ(triangles({}), 1u);
  EXPECT_EQ(triangles({"objects.0.file=part.obj"}), 2u);
  EXPECT_EQ(triangles({"objects=[{type=\"mesh\", file=\"part.obj\"}]"}), 2u);
  EXPECT_EQ(triangles({"background_image=plate.pfm", "image.height=3"}), 1u);
  EXPECT_THROW(triangles({"background_image=plate.pfm"}), Error);
  EXPECT_THROW(triangles({"image.height=3"}), Error);
  std::filesystem::current_path(before);
}

/// The one line that the program says of a scene, with the folder's path left out.
std::string complaint(const Folder& folder, const std::vector<std::string>& flags) {
  std::vector<std::string> words = {"render", folder / "scene.toml", "-o", folder / "out.exr"};
  words.insert(words.end(), flags.begin(), flags.end());
  const auto outcome = test::run(words);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.exr"));
  std::string text = outcome.err;
  const std::string here = folder / "";
  for (std::size_t i; (i = text.find(here)) != std::string::npos;) text.erase(i, here.size());
  return text;
}

TEST(Backgrounds, that_cannot_serve_are_told_in_one_line) {
  const Folder folder;
  test::write_bytes(folder / "scene.toml", "background_image = \"plate.pfm\"\n");
  EXPECT_EQ(complaint(folder, {}),
            "scene.toml:1:20: background_image names a picture that is not to be had: plate.pfm: "
            "cannot be read: No such file or directory\n");
  write_pfm(folder / "plate.pfm", picture_of(noise(8, 6)));
  EXPECT_EQ(complaint(folder, {}),
            "scene.toml:1:20: background_image names a picture of other proportions: plate.pfm is "
            "8 x 6 pixels; accepted: 640 x 360, the picture's, or a size of the same "
            "proportions\n");
  std::string bytes = test::bytes_of(folder / "plate.pfm");
  const float hole = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + bytes.size() - sizeof hole, &hole, sizeof hole);
  test::write_bytes(folder / "hole.pfm", bytes);
  EXPECT_THAT(
      complaint(folder, {"--size", "8x6", "--background", folder / "hole.pfm"}),
      HasSubstr("names a picture with a hole: hole.pfm is nan at pixel 7,0; accepted: finite"));
  test::write_bytes(folder / "text.png", "no picture");
  EXPECT_THAT(complaint(folder, {"--background", folder / "text.png"}),
              HasSubstr("background_image names a picture that is not to be had: text.png"));
}

/// A picture of one number a pixel as an EXR or PFM would hold it, row by row.
Image depths(int width, int height, const std::vector<float>& values) {
  Image image(width, height, 1);
  image.pixels = values;
  return image;
}

/// A PFM of one channel; the format starts at the bottom.
void write_depths(const std::string& path, const Image& image) {
  std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", image.width, image.height);
  for (int y = image.height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(image.row(y).data()), image.row(y).size_bytes());
  test::write_bytes(path, bytes);
}

TEST(DepthImages, of_a_plane_are_the_plane) {
  const CameraFrame frame = camera_frame({.position = {1, 2, 3}, .target = {0, 1, -2}}, {16, 12});
  const Vec3<double> normal = normalize(Vec3<double>(0.3, 0.5, 1)), point(0, 0, -4);
  Image image(16, 12, 1);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x)
      image.at(x, y, 0) = float(dot(point - frame.position, normal) /
                                dot(frame.direction(x + 0.5, y + 0.5), normal));
  const Mesh mesh = depth_surface(image, frame, 0.1);
  ASSERT_EQ(mesh.positions.size(), 19u * 15);  // with one pixel more all around
  EXPECT_EQ(mesh.triangles.size(), 2u * 18 * 14);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [u, v] = mesh.uvs[i];
    if (u < 0 || u > 1 || v < 0 || v > 1) continue;  // the pixels around have no neighbours
    EXPECT_NEAR(dot(Vec3<double>(mesh.positions[i]) - point, normal), 0, 2e-5) << u << ", " << v;
  }
}

TEST(DepthImages, join_no_pixels_across_a_jump) {
  const CameraFrame frame = camera_frame({.position = {0, 0, 0}, .target = {0, 0, -1}}, {24, 18});
  Image image(24, 18, 1);
  std::mt19937 random(3);
  for (float& depth : image.pixels)  // a few levels, so that some neighbours are joined
    depth = std::pow(1.05f, float(random() % 12));
  constexpr double jump = 0.1;
  const Mesh mesh = depth_surface(image, frame, jump);
  for (const auto& triangle : mesh.triangles) {
    double nearest = far_away, farthest = 0;
    for (const std::uint32_t corner : triangle) {
      const double depth = -double(mesh.positions[corner].z);
      nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
    }
    // The mean of a corner is at most two steps from the pixel, so corners are four from each
    // other.
    EXPECT_LT(farthest / nearest, std::pow(1 + jump, 4) + 1e-6);
  }
}

TEST(DepthImages, have_no_gap_for_their_camera) {
  Scene scene;
  scene.resolution = {32, 24};
  Image image(32, 24, 1);
  std::mt19937 random(5);
  for (float& depth : image.pixels) depth = 1 + 4 * float(random() % 4);
  Material black;
  black.albedo = {};
  scene.objects = {
      {"place", depth_surface(image, camera_frame(scene.camera, scene.resolution), 0.1), black}};
  scene.background = Rgb<double>(1);
  scene.render.spp = 64, scene.render.samples_per_ray = 1;
  const Image beauty = Renderer(scene).render(scene.render).film.layer("beauty");
  for (const float light : beauty.pixels) ASSERT_EQ(light, 0);
}

/// A room with a ball, seen by a camera that looks down a little; the sky above the far wall.
constexpr const char* place = R"(
ambient = 1
[camera]
position = [0.3, 1.5, 4]
target = [0, 0.8, 0]
fov = 50
[image]
width = 64
height = 48
[render]
spp = 4
samples_per_ray = 0
[[objects]]
type = "box"
min = [-4, -0.1, -3]
max = [4, 0, 5]
[[objects]]
type = "box"
min = [-4, 0, -3.1]
max = [4, 1.8, -3]
[[objects]]
type = "sphere"
centre = [0, 0.7, 0]
radius = 0.7
)";

TEST(DepthImages, of_a_render_are_seen_at_the_depths_of_the_render) {
  const Folder folder;
  test::write_bytes(folder / "place.toml", place);
  ASSERT_EQ(test::run({"render", folder / "place.toml", "-o", folder / "place.exr"}).status, 0);
  const Image want = read_numbers(folder / "place.exr", "depth.Z").image;
  Scene scene = parse_scene(place, folder / "place.toml");
  const Scene seen = parse_scene(
      "[[objects]]\ntype = \"depth_image\"\nfile = \"place.exr\"\nmeasure = \"ray\"\n"
      "[image]\nwidth = 64\nheight = 48\n"
      "[camera]\nposition = [0.3, 1.5, 4]\ntarget = [0, 0.8, 0]\nfov = 50\n",
      folder / "seen.toml");
  scene.objects = seen.objects;
  const Image got = Renderer(scene).render(scene.render).film.layer("depth");
  int nothing = 0, off = 0;
  for (std::size_t i = 0; i < got.pixels.size(); ++i) {
    // At most a step to a neighbour, where the surface bends or ends; none where it is flat.
    ASSERT_NEAR(got.pixels[i], want.pixels[i], 0.1f * want.pixels[i]) << i % 64 << ", " << i / 64;
    off += std::abs(got.pixels[i] - want.pixels[i]) > 2e-5f * want.pixels[i];
    nothing += want.pixels[i] == 0;
  }
  EXPECT_LT(off, 550);     // of 3072: the ball (400), edges and creases
  EXPECT_GT(nothing, 64);  // of sky
}

TEST(DepthImages, take_what_is_no_depth_for_nothing) {
  const Folder folder;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  // Every other column, so that each pixel with a depth stands alone.
  write_depths(folder / "depths.pfm",
               depths(5, 3, {nan, 1, 0, 2, infinity, nan, 1, 0, 2, infinity, nan, 1, -3, 2, 100}));
  const Scene scene = parse_scene(
      "[image]\nwidth = 10\nheight = 6\n[camera]\nposition = [0, 0, 0]\ntarget = [0, 0, -1]\n"
      "[[objects]]\ntype = \"depth_image\"\nfile = \"depths.pfm\"\nfarthest = 50\nunit = 2\n",
      folder / "scene.toml");
  ASSERT_FALSE(mesh_of(scene).positions.empty());
  for (const Vec3<float>& p : mesh_of(scene).positions)
    EXPECT_TRUE(std::abs(p.z + 2) < 1e-6f || std::abs(p.z + 4) < 1e-6f) << p.z;
}

TEST(DepthImages, come_as_codes_of_a_png_too) {
  const Folder folder;
  const std::vector<png_uint_16> codes = {1500, 1500, 3000, 3000};
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = header.height = 2;
  header.format = PNG_FORMAT_LINEAR_Y;
  ASSERT_TRUE(png_image_write_to_file(&header, (folder / "depths.png").c_str(), 0, codes.data(), 0,
                                      nullptr));
  const std::string text =
      "[image]\nwidth = 2\nheight = 2\n[camera]\nposition = [0, 0, 0]\ntarget = [0, 0, -1]\n"
      "[[objects]]\ntype = \"depth_image\"\nfile = \"depths.png\"\n";
  const Scene scene = parse_scene(text + "unit = 0.001\n", folder / "scene.toml");
  for (const Vec3<float>& p : mesh_of(scene).positions)
    EXPECT_TRUE(std::abs(p.z + 1.5f) < 1e-6f || std::abs(p.z + 3) < 1e-6f) << p.z;
  test::write_bytes(folder / "scene.toml", text);
  EXPECT_EQ(complaint(folder, {}),
            "scene.toml:7:1: objects.0.unit is missing; a number above 0 m: what one code of a PNG "
            "stands for, such as 0.001\n");
}

TEST(DepthImages, may_have_a_camera_of_their_own) {
  const Folder folder;
  write_depths(folder / "depths.pfm", depths(3, 3, std::vector<float>(9, 2)));
  const Scene scene = parse_scene(
      "[[objects]]\ntype = \"depth_image\"\nfile = \"depths.pfm\"\nholdout = true\n"
      "camera = {position = [5, 0, 0], target = [0, 0, 0], fov = 90}\n",
      folder / "scene.toml");
  EXPECT_TRUE(scene.objects[0].holdout);
  for (const Vec3<float>& p : mesh_of(scene).positions) {
    EXPECT_NEAR(p.x, 3, 1e-6);
    EXPECT_LE(std::abs(p.y), 4 + 1e-5);
  }
}

TEST(DepthImages, that_cannot_serve_are_told_in_one_line) {
  const Folder folder;
  const auto scene = [&](const std::string& keys) {
    test::write_bytes(folder / "scene.toml", "[[objects]]\ntype = \"depth_image\"\n" + keys);
  };
  scene("file = \"none.exr\"\n");
  EXPECT_EQ(complaint(folder, {}),
            "scene.toml:3:8: objects.0.file names a depth image that is not to be had: none.exr: "
            "cannot be read: No such file or directory\n");
  write_depths(folder / "depths.pfm", depths(3, 3, std::vector<float>(9, 2)));
  scene("file = \"depths.pfm\"\n");
  EXPECT_EQ(complaint(folder, {}),
            "scene.toml:3:8: objects.0.file names a depth image of other proportions: depths.pfm "
            "is 3 x 3 pixels; accepted: 640 x 360, the picture's, a size of the same proportions, "
            "or a camera of its own\n");
  write_depths(folder / "depths.pfm",
               depths(2, 1, std::vector<float>(2, std::numeric_limits<float>::quiet_NaN())));
  EXPECT_THAT(complaint(folder, {"--size", "8x4"}),
              HasSubstr("names a depth image without any depth: depths.pfm; accepted: at least one "
                        "pixel above 0"));
  write_pfm(folder / "depths.pfm", picture_of(noise(2, 2)));
  EXPECT_THAT(complaint(folder, {}), HasSubstr("accepted: EXR, PFM and PNG of one channel"));
  write_exr(folder / "depths.exr", picture_of(noise(2, 2)), ExrType::half);
  scene("file = \"depths.exr\"\n");
  EXPECT_THAT(complaint(folder, {}), HasSubstr("it has no channel Z or depth.Z; it has: B, G, R"));
  scene("file = \"depths.exr\"\nchannel = \"G\"\ndiscontinuity = 0\n");
  EXPECT_THAT(complaint(folder, {}), HasSubstr("objects.0.discontinuity = 0 is out of range"));
}

}  // namespace
}  // namespace airlight
