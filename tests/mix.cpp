// Lights dimmed and coloured in a picture that is rendered already.
#include "image/mix.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <ctime>
#include <limits>

#include "error.h"
#include "image/input.h"
#include "image/output.h"
#include "render/render.h"
#include "scene/load_scene.h"
#include "support/refused.h"

namespace airlight::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A ball in fog between a sun, two lamps of one group, a light without one, and a background.
std::string scene_text(double sun, const Rgb<double>& lamp, bool grey) {
  return fmt::format(R"(
background = [0.3, 0.2, 0.1]
ambient = 0.2
[camera]
position = [0, 0.2, 3.1]
target = [0, 0, 0]
[image]
width = 40
height = 26
[[media]]
albedo = 0.9
sigma_t = {}
shape = {{type = "box", min = [-1, -1, -1], max = [1, 1, 1]}}
[[lights]]
type = "directional"
irradiance = {}
direction = [-1, -1, 0.2]
group = "sun"
[[lights]]
type = "directional"
irradiance = [{}, {}, {}]
direction = [1, -0.3, 0.2]
group = "lamp"
[[lights]]
type = "directional"
irradiance = [{}, {}, {}]
direction = [1, -0.3, -0.4]
group = "lamp"
[[lights]]
type = "directional"
irradiance = 3
direction = [0, -1, -1]
[[objects]]
type = "sphere"
radius = 0.7
)",
                     grey ? "1.5" : "[0.3, 1, 3]", sun, 2 * lamp.r, 3 * lamp.g, 4 * lamp.b, lamp.r,
                     2 * lamp.g, 9 * lamp.b);
}

const Rgb<double> as_is(1, 1, 1), dimmed(0.25, 0.25, 0.25), tinted(1.5, 1, 0.25);

/// Renders a crop to an EXR file.
void render(const std::string& file, double sun, const Rgb<double>& lamp, ExrType precision,
            const std::string& estimator = "rewv", bool grey = false) {
  const Scene scene =
      parse_scene(scene_text(sun, lamp, grey), "scene.toml", {"render.estimator=" + estimator});
  RenderControl control;
  control.crop = PixelRect{3, 2, 33, 21};
  const Rendered done = Renderer(scene).render(scene.render, control);
  write_exr(file, done.film.picture(), precision);
}

/// The largest difference in any pixel of a layer, over the pixel's value or the layer's mean.
double largest_difference(const Image& a, const Image& b) {
  double mean = 0, worst = 0;
  for (const float x : a.pixels) mean += std::abs(x) / double(a.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (a.pixels[i] != b.pixels[i])
      worst = std::max(worst, std::abs(double(a.pixels[i]) - b.pixels[i]) /
                                  std::max<double>(std::abs(a.pixels[i]), mean));
  return worst;
}

std::vector<std::string> layers_of(const std::string& file) {
  std::vector<std::string> names;
  for (const Layer& layer : read_picture(file).layers) names.push_back(layer.name);
  return names;
}

Image alpha_of(const std::string& file) {
  const Picture picture = read_picture(file);
  Image image(picture.width, picture.height, 1);
  for (int y = 0; y < picture.height; ++y) picture.alpha->fill(y, image.row(y));
  return image;
}

// In RGB fog the samples follow the light's colour: dimmed by a power of two it has the same ones.
TEST(Mix, is_a_render_under_other_lights) {
  const struct {
    ExrType precision;
    double rounding;  // of sums of three to four layers, against one
    bool grey;
    float sun;
    Rgb<double> gain;
  } cases[] = {{ExrType::single, 2e-6, true, 0.4F, tinted},
               {ExrType::single, 2e-6, false, 0.5F, dimmed},
               {ExrType::half, 4e-3, true, 0.4F, tinted}};
  for (const auto& [precision, rounding, grey, sun, gain] : cases)
    for (const char* estimator : {"rewv", "mcwvds", "reds"}) {
      const Folder folder;
      const std::string plain = folder / "plain.exr", wanted = folder / "wanted.exr";
      render(plain, 5, as_is, precision, estimator, grey);
      render(wanted, 5 * sun, gain, precision, estimator, grey);
      const Picture mixed =
          mix(read_picture(plain),
              {{"sun", {sun, sun, sun}}, {"lamp", {float(gain.r), float(gain.g), float(gain.b)}}});
      const std::string file = folder / "mixed.exr";
      write_exr(file, mixed, precision);
      for (const std::string& layer : layers_of(wanted)) {
        if (layer == "standard_error") continue;
        const std::string name = layer == "beauty" ? "" : layer;
        EXPECT_LT(largest_difference(read_image(wanted, name), read_image(file, name)), rounding)
            << layer << ", " << estimator << (grey ? " in grey fog" : " in RGB fog");
      }
      EXPECT_THAT(layers_of(file), Not(testing::Contains("standard_error")));
      EXPECT_EQ(layers_of(file).size() + 1, layers_of(wanted).size());
      EXPECT_EQ(read_picture(file).crop->x0, 3);
      EXPECT_EQ(read_picture(file).crop->full_height, 26);
    }
}

/// The scene over a floor that the background shows. More changes may follow.
Film over_holdout(std::vector<Override> changes, int max_depth) {
  const std::string text = scene_text(5, as_is, true) + R"(
[[objects]]
type = "rectangle"
corner = [-3, -1.1, 2]
u = [6, 0, 0]
v = [0, 0, -6]
holdout = true
)";
  changes.push_back(fmt::format("render.max_depth={}", max_depth));
  const Scene scene = parse_scene(text, "scene.toml", changes);
  return Renderer(scene).render(scene.render).film;
}

// Shadows on holdouts are quotients of sums over all lights.
TEST(Mix, changes_the_shadows_on_holdouts) {
  const std::vector<Gain> gains = {
      {"sun", {0.5F, 0, 2}}, {"lamp", {0.25F, 8, 1}}, {"ungrouped", {0.5F, 2, 0.5F}}};
  for (const int max_depth : {1, 3}) {
    const Film before = over_holdout({}, max_depth);
    const Film wanted =
        over_holdout({"lights.0.irradiance=[2.5, 0, 10]", "lights.1.irradiance=[0.5, 24, 4]",
                      "lights.2.irradiance=[0.25, 16, 9]", "lights.3.irradiance=[1.5, 6, 1.5]",
                      "ambient=[0.1, 0.4, 0.1]", "background=[0.15, 0.4, 0.05]"},
                     max_depth);
    EXPECT_GT(largest_difference(before.layer("shadow"), wanted.layer("shadow")), 0.2);
    for (const bool over_nothing : {false, true}) {
      Picture picture = before.picture(), other = wanted.picture();
      if (over_nothing) add_alpha(picture), add_alpha(other);
      const Folder folder;
      const std::string mixed = folder / "mixed.exr", rendered = folder / "rendered.exr";
      write_exr(mixed, mix(picture, gains), ExrType::single);
      write_exr(rendered, other, ExrType::single);
      for (const std::string& layer : layers_of(rendered)) {
        if (layer == "standard_error") continue;
        const std::string name = layer == "beauty" ? "" : layer;
        EXPECT_LT(largest_difference(read_image(rendered, name), read_image(mixed, name)), 4e-6)
            << layer << ", max_depth " << max_depth;
      }
      if (over_nothing) {
        EXPECT_LT(largest_difference(alpha_of(rendered), alpha_of(mixed)), 2e-6);
      }
    }
  }
}

TEST(Mix, needs_no_light_for_a_group) {
  Scene scene = parse_scene(scene_text(20, Rgb<double>(1.), true), "scene.toml");
  scene.lights.resize(1);  // as a program may do
  scene.render.spp = 1;
  const Film film = Renderer(scene).render(scene.render).film;
  EXPECT_THAT(film.groups, ElementsAre("", "sun", "lamp"));
  EXPECT_GT(film.radiance(20, 13).g, 0);
}

TEST(Mix, puts_out_and_can_be_done_again) {
  const Folder folder;
  render(folder / "a.exr", 5, as_is, ExrType::single);
  const Picture dark = mix(read_picture(folder / "a.exr"),
                           {{"sun", {0, 0, 0}}, {"lamp", {0, 0, 0}}, {"ungrouped", {0, 0, 0}}});
  std::vector<float> row(33 * 3);
  for (int y = 0; y < 21; ++y) {
    dark.layers[0].fill(y, row);
    EXPECT_THAT(row, testing::Each(0));
  }
  write_exr(folder / "b.exr", mix(read_picture(folder / "a.exr"), {{"sun", {4, 4, 4}}}),
            ExrType::single);
  write_exr(folder / "c.exr", mix(read_picture(folder / "b.exr"), {{"sun", {.25F, .25F, .25F}}}),
            ExrType::single);
  EXPECT_LT(largest_difference(read_image(folder / "a.exr"), read_image(folder / "c.exr")), 2e-6);
}

TEST(ReadPicture, gives_back_what_was_written) {
  const Folder folder;
  render(folder / "opaque.exr", 5, as_is, ExrType::half);
  Picture written = read_picture(folder / "opaque.exr");
  add_alpha(written);
  write_exr(folder / "a.exr", written, ExrType::half);
  const Picture read = read_picture(folder / "a.exr");
  ASSERT_TRUE(read.alpha);
  EXPECT_EQ(read.layers[0].name, "beauty");
  EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(light_groups(read), (std::vector<std::string>{"lamp", "sun", "ungrouped"}));
  write_exr(folder / "b.exr", read, ExrType::half);
  EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
}

TEST(ReadPicture, unpacks_a_file_once_and_not_once_a_layer) {
  const Folder folder;
  constexpr int layers = 60;
  Picture many;
  many.width = 256, many.height = 128;
  for (int i = 0; i < layers; ++i) {
    const auto waves = [i](int y, std::span<float> row) {
      for (std::size_t k = 0; k < row.size(); ++k)
        row[k] = float(std::sin(double(k) + 1.7 * y + i));
    };
    many.layers.push_back({i == 0 ? "beauty" : fmt::format("l{}", i), {"R", "G", "B"}, waves});
  }
  write_exr(folder / "many.exr", many, ExrType::half);
  const auto processor_time = [](auto&& read) {
    std::clock_t least = std::numeric_limits<std::clock_t>::max();
    for (int i = 0; i < 3; ++i) {
      const std::clock_t start = std::clock();
      read();
      least = std::min(least, std::clock() - start);
    }
    return double(least);
  };
  const double of_one = processor_time([&] { read_image(folder / "many.exr", "l7"); });
  const double of_all = processor_time([&] { read_picture(folder / "many.exr"); });
  EXPECT_LT(of_all, layers / 4. * of_one);  // to unpack dominates, and is the same for both
}

TEST(Mix, is_a_verb_that_tells_what_there_is) {
  const Folder folder;
  const std::string in = folder / "in.exr", out = folder / "out.exr", png = folder / "out.png";
  render(in, 5, as_is, ExrType::half);
  const Outcome done = run({"mix", in, "--gain", "sun=0.4", "--gain", "lamp=1.2,1,0.8", "-o", out,
                            "-o", png, "--exposure", "1"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out, fmt::format("{}, {}: 33 x 21, sun=0.4 lamp=1.2,1,0.8\n", out, png));
  EXPECT_EQ(read_metadata(out)["mix"], "sun=0.4 lamp=1.2,1,0.8");
  EXPECT_EQ(read_metadata(out)["estimator"], read_metadata(in)["estimator"]);
  EXPECT_EQ(run({"mix", out, "--gain", "sun=2", "-o", folder / "again.exr"}).status, 0);
  EXPECT_EQ(read_metadata(folder / "again.exr")["mix"], "sun=0.4 lamp=1.2,1,0.8, then sun=2");

  const std::vector<std::string> before = folder.names();
  const std::string no = folder / "no.exr";
  expect_refused(run({"mix", in, "--gain", "moon=1", "-o", no}),
                 in + ": has no light group moon; it has: lamp, sun, ungrouped");
  for (const char* gain : {"sun", "sun=", "sun=-1", "sun=1,2", "sun=x", "sun=nan", "=1", "sun=1;"})
    expect_refused(
        run({"mix", in, "--gain", gain, "-o", no}),
        fmt::format("--gain {}: is no gain; accepted: GROUP=FACTOR or GROUP=R,G,B", gain));
  expect_refused(run({"mix", in, "--gain", "sun=1", "--gain", "sun=2", "-o", no}),
                 "--gain sun=2: its group has a gain already");
  expect_refused(run({"mix", png, "--gain", "sun=1", "-o", no}), "only EXR files have layers");
  expect_refused(run({"mix", folder / "none.exr", "--gain", "sun=1", "-o", no}),
                 "none.exr: cannot be read: No such file or directory");
  Image grey(2, 2);
  write_exr(folder / "grey.exr", picture_of(grey), ExrType::half);
  expect_refused(run({"mix", folder / "grey.exr", "--gain", "sun=1", "-o", no}),
                 "grey.exr: has no light groups; accepted: an EXR of a scene whose lights have a");
  std::filesystem::remove(folder / "grey.exr");
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace airlight::test
