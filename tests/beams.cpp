// Beams as scenes know them: what a file says of them and what is said about mistakes, images in
// beams, what a start plane does to shadows, and what arrives on surfaces.

#include <gmock/gmock.h>

#include <fstream>

#include "error.h"
#include "geometry/beam_image.h"
#include "geometry/world.h"
#include "render/render.h"
#include "scene/load_scene.h"
#include "support/folder.h"
#include "support/quadrature.h"
#include "support/stats.h"

namespace airlight {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Vector = Vec3<double>;

std::string beam_of(const std::string& keys) {
  return "[[lights]]\ntype = \"collimated\"\nirradiance = 1\nposition = [0, 2, 0]\n" + keys;
}
const std::string down = "direction = [0, -3, 0]\n";
const std::string round_ = "cross_section = {type = \"circle\", radius = 0.5}\n";

Collimated read(const std::string& keys) {
  return std::get<Collimated>(parse_scene(beam_of(keys), "stage.toml").lights.at(0));
}

std::string error_of(const std::string& keys) {
  try {
    parse_scene(beam_of(keys), "stage.toml");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

void expect_near(const Vector& a, const Vector& b) {
  EXPECT_LT(length(a - b), 1e-15) << a.x << ", " << a.y << ", " << a.z;
}

TEST(BeamsInFiles, go_where_direction_or_target_says) {
  expect_near(read(down + round_).direction, {0, -1, 0});
  expect_near(read("target = [3, -2, 0]\n" + round_).direction, {0.6, -0.8, 0});
}

TEST(BeamsInFiles, have_axes_as_a_camera_that_looks_along_them) {
  const Collimated beam = read("direction = [0, 0, -1]\n" + round_);
  expect_near(beam.right, {1, 0, 0}), expect_near(beam.up, {0, 1, 0});
  const Collimated vertical = read(down + round_);
  expect_near(vertical.right, {1, 0, 0}), expect_near(vertical.up, {0, 0, -1});
  expect_near(read(down + round_ + "up = [5, 5, 0]\n").up, {1, 0, 0});
}

TEST(BeamsInFiles, have_the_outline_said) {
  EXPECT_EQ(read(down + round_).cross_section.radius, 0.5);
  const CrossSection rectangle =
      read(down + "cross_section = {type = \"rectangle\", width = 2, height = 4}\n").cross_section;
  EXPECT_EQ(rectangle.high.x, 1);
  EXPECT_EQ(rectangle.low.y, -2);
  const Collimated beam =
      read(down + "cross_section = {type = \"polygon\", corners = [[0, 0], [2, 0], [0, 1]]}\n");
  EXPECT_TRUE(beam.contains(Vector(0.5, 0, -0.5)));   // (0.5, 0.5) in the cross-section
  EXPECT_FALSE(beam.contains(Vector(1.5, 0, -0.5)));  // beyond the long side
  EXPECT_FALSE(beam.contains(Vector(0.5, 3, -0.5)));  // before the start
}

TEST(BeamsInFiles, are_refused_with_a_reason) {
  EXPECT_EQ(error_of(round_), "stage.toml:1:1: lights.0 lacks direction, or target");
  EXPECT_THAT(error_of(down + round_ + "target = [0, 0, 0]\n"),
              HasSubstr("lights.0 has direction and target; accepted: direction, or target"));
  EXPECT_EQ(error_of("direction = [0, 0, 0]\n" + round_),
            "stage.toml:5:13: lights.0.direction = [0, 0, 0] is no direction: at least one number "
            "must not be 0");
  EXPECT_THAT(error_of("target = [0, 2, 0]\n" + round_),
              HasSubstr("is the light's own position; accepted: any other point"));
  EXPECT_THAT(error_of(down + round_ + "up = [0, 2, 0]\n"),
              HasSubstr("is parallel to the beam; accepted: any other direction"));
  EXPECT_THAT(error_of(down), HasSubstr("lights.0.cross_section is missing"));
  EXPECT_EQ(error_of(down + "cross_section = {type = \"circle\", radius = 0}\n"),
            "stage.toml:6:44: lights.0.cross_section.radius = 0 is out of range: a number in "
            "[1e-06, 1000000] m (of the beam)");
  EXPECT_THAT(error_of(down + "cross_section = {type = \"rectangle\", width = 1}\n"),
              HasSubstr("lights.0.cross_section.height is missing"));
  const auto corners = [](const std::string& list) {
    return error_of(down + "cross_section = {type = \"polygon\", corners = [" + list + "]}\n");
  };
  EXPECT_EQ(corners("[0, 0], [2, 0], [0.5, 0.5], [0, 2]"),
            "stage.toml:6:46: lights.0.cross_section.corners is not convex; accepted: the 3 to 32 "
            "corners [x, y] of a convex polygon, in turn");
  EXPECT_THAT(corners("[0, 1], [0.6, -0.8], [-0.95, 0.3], [0.95, 0.3], [-0.6, -0.8]"),
              HasSubstr("is not convex"));  // a star
  EXPECT_THAT(corners("[0, 0], [1, 0]"), HasSubstr("has 2 corners; accepted"));
  EXPECT_THAT(corners("[0, 0], [0, 0], [1, 0], [0, 1]"), HasSubstr("the same corner twice"));
  EXPECT_THAT(corners("[0, 0], [1, 1], [2, 2]"), HasSubstr("spans no area"));
}

TEST(BeamsInFiles, say_which_image_cannot_be_read) {
  const test::Folder folder;
  std::ofstream(folder / "broken.png") << "\x89PNG and no more";
  for (const char* name : {"absent.png", "broken.png"}) {
    std::ofstream(folder / "stage.toml") << beam_of(down + round_ + "image = \"" + name + "\"\n");
    try {
      load_scene(folder / "stage.toml");
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_THAT(
          error.what(),
          HasSubstr("stage.toml:7:9: lights.0.image names a picture that is not to be had: "));
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  }
}

// --- rendered ------------------------------------------------------------------------------------

/// A pixel that looks down -z, from outside, through a box of fog at a beam from above.
Scene beam_in_a_box() {
  Scene scene;
  scene.resolution = {4, 4};
  scene.camera = {.position = {0, 0, 4}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 14};
  Medium fog;
  fog.sigma_s = {0.5, 0.7, 0.9}, fog.sigma_t = {0.6, 0.9, 1.4};
  scene.media = {fog};
  Collimated beam;
  beam.irradiance = {3, 2, 1};
  beam.direction = normalize(Vector(0.2, -1, -0.1));
  beam.right = normalize(cross(beam.direction, Vector(0, 1, 0)));
  beam.up = cross(beam.right, beam.direction);
  beam.position = Vector(0.05, 0, 0.1) - beam.direction * 0.8;
  beam.cross_section = CrossSection::circle(0.7);
  scene.lights = {beam};
  scene.render.threads = 1;
  scene.render.isa = InstructionSet::reference;
  scene.render.visibility = Visibility::analytic;
  scene.render.samples_per_ray = 0;
  return scene;
}

Rgb<double> mean_in_scatter(const Film& film) {
  Rgb<double> sum;
  for (const PixelSums& pixel : film.pixels()) sum += mean_estimate(pixel).radiance();
  return sum * (1. / double(film.pixel_count()));
}

void add_ball(Scene& scene, const Vector& centre, double radius) {
  Material black;
  black.albedo = Rgb<double>(0.);
  scene.objects.push_back({"ball", Sphere{centre, radius}, black});
}

/// Means over the picture from seeds 0 to n − 1.
std::array<std::vector<double>, 3> means_of_seeds(Scene& scene, int n) {
  Renderer renderer(scene);
  std::array<std::vector<double>, 3> means;
  for (int seed = 0; seed < n; ++seed) {
    scene.render.seed = seed;
    const Rgb<double> mean = mean_in_scatter(renderer.render(scene.render).film);
    for (int k = 0; k < 3; ++k) means[std::size_t(k)].push_back(mean[k]);
  }
  return means;
}

TEST(BeamsInScenes, are_shaded_by_what_stands_beyond_their_start_only) {
  Scene scene = beam_in_a_box();
  const auto& beam = std::get<Collimated>(scene.lights[0]);
  const Vector start = beam.position, across = beam.right * 0.3;
  add_ball(scene, start - beam.direction * 0.3, 0.25);            // all before the start
  add_ball(scene, start + across - beam.direction * 0.05, 0.15);  // its cap reaches into the beam
  add_ball(scene, start - across + beam.direction * 0.05, 0.15);  // its cap looks out
  Mesh blade;                                                     // cuts through the start plane
  for (const auto& [x, y] : {std::pair(-0.4, -0.2), {0.4, -0.2}, {0.0, 0.3}})
    blade.positions.push_back(
        Vec3<float>(start + beam.up * 0.3 + beam.right * x + beam.direction * y));
  blade.triangles = {{0, 1, 2}};
  Material black;
  black.albedo = Rgb<double>(0.);
  scene.objects.push_back({"blade", blade, black});

  Scene open = scene;
  open.objects.clear();
  scene.render.estimator = open.render.estimator = "closed_form";
  scene.render.spp = open.render.spp = 1;
  const Rgb<double> truth = mean_in_scatter(render(scene).film);
  EXPECT_LT(truth.g, 0.97 * mean_in_scatter(render(open).film).g);

  scene.render.estimator = "whole_volume+difference";
  scene.render.spp = 256;
  const auto means = means_of_seeds(scene, 24);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(test::relative_standard_error(means[std::size_t(k)]), 5e-4);
    // Films keep floats, and the blade's corners are floats.
    EXPECT_LT(std::abs(test::z_score(means[std::size_t(k)], truth[k], 1e-6 * truth[k])), 4);
  }
}

/// Two texels side by side, the first one black: from there to the middle of the second one,
/// transmittance rises as a straight line.
Texture ramp(std::array<std::uint8_t, 3> second) {
  Texture image;
  image.width = 2, image.height = 1;
  image.rgba = {0, 0, 0, 255, second[0], second[1], second[2], 255};
  image.wrap_u = image.wrap_v = Wrap::clamp;
  return image;
}

TEST(BeamsInScenes, do_not_pass_where_their_image_is_transparent) {
  Scene scene = beam_in_a_box();
  auto& beam = std::get<Collimated>(scene.lights[0]);
  beam.cross_section = CrossSection::rectangle(1.2, 1.4);
  Texture white;
  white.width = white.height = 1;
  for (const std::uint8_t alpha : {0, 51, 255}) {
    white.rgba = {255, 255, 255, alpha};
    const auto passed = through_image<double>(beam, white, beam.position + beam.direction, true);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(passed[c], alpha / 255., 1e-6);
  }
}

TEST(BeamsInScenes, do_not_pass_what_hides_in_transparent_parts_of_their_image) {
  Scene scene = beam_in_a_box();
  auto& beam = std::get<Collimated>(scene.lights[0]);
  beam.cross_section = CrossSection::rectangle(1.2, 1.4);
  Texture edge;  // half white, half transparent: white fades out as on black, whatever hides there
  edge.width = 2, edge.height = 1;
  for (const std::uint8_t hidden : {0, 90, 255}) {
    edge.rgba = {255, 255, 255, 255, hidden, hidden, hidden, 0};
    for (const double part : {0., 0.25, 0.5, 1.}) {  // of the way between the texels' centres
      const Vector at = beam.position + beam.direction + beam.right * ((part - 0.5) * 0.6);
      const auto passed = through_image<double>(beam, edge, at, true);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(passed[c], 1 - part, 1e-6) << int(hidden);
    }
  }
}

TEST(BeamsInScenes, with_an_image_give_what_quadrature_gives) {
  // 255 passes all and 0 nothing; 188 of sRGB is 0.5029 of the light.
  const Rgb<double> brightest(1, std::pow((188 / 255. + 0.055) / 1.055, 2.4), 0);
  Scene scene = beam_in_a_box();
  scene.resolution = {1, 1};
  scene.textures = {ramp({255, 188, 0})};
  auto& beam = std::get<Collimated>(scene.lights[0]);
  beam.image = 0;
  beam.cross_section = CrossSection::rectangle(1.2, 1.4);

  const Medium& fog = scene.media[0];
  const Vector d(0, 0, -1), w = beam.toward(), o(0, 0, 1);  // where the ray enters the box
  // x of the cross-section at the entry, and what it gains a metre: linear along the ray, and so
  // are the ends of the beam.
  const auto at = [&](const Vector& axis) {
    return std::pair(dot(o - beam.position, axis), dot(d, axis));
  };
  const auto [x0, x1] = at(beam.right);
  const auto [y0, y1] = at(beam.up);
  const auto [s0, s1] = at(beam.direction);
  std::vector<double> breaks;
  for (const double x : {-0.6, -0.3, 0.3, 0.6}) breaks.push_back((x - x0) / x1);
  for (const double y : {-0.7, 0.7}) breaks.push_back((y - y0) / y1);
  breaks.push_back(-s0 / s1);
  Rgb<double> truth;
  for (int k = 0; k < 3; ++k)
    truth[k] = fog.sigma_s[k] * beam.irradiance[k] / (4 * pi) *
               test::integrate(
                   0, 2,
                   [&, x0 = x0, x1 = x1, y0 = y0, y1 = y1, s0 = s0, s1 = s1](double t) {
                     const double x = x0 + t * x1, y = y0 + t * y1, start = s0 + t * s1;
                     if (std::abs(x) > 0.6 || std::abs(y) > 0.7 || start < 0) return 0.;
                     const Vector p = o + d * t;
                     double way = start;
                     for (int j = 0; j < 3; ++j)
                       way = std::min(way, ((w[j] > 0 ? 1 : -1) - p[j]) / w[j]);
                     const double passes = std::clamp((x + 0.3) / 0.6, 0., 1.) * brightest[k];
                     return passes * std::exp(-fog.sigma_t[k] * (t + way));
                   },
                   1e-10, breaks);
  EXPECT_GT(truth.r, 0);
  EXPECT_EQ(truth.b, 0);
  for (const char* estimator : {"rm", "mcwvds", "distance+difference"}) {
    scene.render.estimator = estimator;
    scene.render.spp = 1024;
    const auto means = means_of_seeds(scene, 24);
    for (int k = 0; k < 2; ++k) {
      EXPECT_LT(test::relative_standard_error(means[std::size_t(k)]), 5e-4);
      // Texels are floats.
      EXPECT_LT(std::abs(test::z_score(means[std::size_t(k)], truth[k], 1e-6 * truth[k])), 4)
          << estimator;
    }
    EXPECT_NEAR(mean(means[2]), 0, 1e-4 * truth.r);  // of differences
  }
  scene.render.estimator = "rewv";  // a quotient, pooled: its bias is below 1e-4 at this count
  scene.render.spp = 1 << 16;
  const Rgb<double> pooled = mean_in_scatter(render(scene).film);
  EXPECT_NEAR(pooled.r, truth.r, 1e-4 * truth.r);
}

TEST(BeamsInScenes, filter_by_their_image_and_camera_rays_do_not) {
  Scene scene = beam_in_a_box();
  scene.textures = {ramp({255, 255, 255})};
  std::get<Collimated>(scene.lights[0]).image = 0;
  const auto& beam = std::get<Collimated>(scene.lights[0]);
  const World world(scene, Visibility::analytic);
  const auto passes = [&](double x, int light) {
    return world
        .transmit<double>(beam.position + beam.right * x + beam.direction, beam.toward(), 1., light,
                          true)
        .g;
  };
  EXPECT_NEAR(passes(-0.6, 0), 0, 1e-6);
  EXPECT_NEAR(passes(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(passes(0.6, 0), 1, 1e-6);
  EXPECT_EQ(passes(-0.6, no_light), 1);
}

TEST(BeamsInScenes, bring_a_floor_the_energy_they_start_with) {
  // Seen from far above, pixels are equal squares of the floor; a tilted beam meets more of it and
  // each point gets less.
  Scene scene;
  scene.resolution = {200, 200};
  scene.camera = {.position = {0, 1000, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fov = 0.23};
  Mesh floor;
  floor.positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  Material grey;
  grey.albedo = Rgb<double>(0.4);
  scene.objects.push_back({"floor", floor, grey});
  Collimated beam;
  beam.irradiance = Rgb<double>(7.);
  beam.direction = normalize(Vector(1, -1, 0.3));
  beam.right = normalize(cross(beam.direction, Vector(0, 1, 0)));
  beam.up = cross(beam.right, beam.direction);
  beam.position = beam.direction * -3.;
  scene.render.spp = 4, scene.render.samples_per_ray = 1, scene.render.filter = PixelFilter::box;
  scene.render.isa = InstructionSet::reference;
  const double width = 2 * 1000 * std::tan(0.23 * pi / 360) / 200;
  const auto flux = [&] {
    const Film film = render(scene).film;
    double sum = 0;
    for (const PixelSums& pixel : film.pixels()) sum += pixel.surface.g / pixel.sample_count();
    return sum * pi / 0.4 * width * width;
  };
  // 4 samples in each of the 1000 pixels on the outline: 3 % of a pixel's area in each of 5000.
  for (const double radius : {0.5, 0.9}) {
    beam.cross_section = CrossSection::circle(radius);
    scene.lights = {beam};
    EXPECT_NEAR(flux(), 7 * pi * radius * radius, 3e-3 * 7 * pi * radius * radius);
  }
  beam.cross_section = CrossSection::rectangle(1.1, 1.3);
  scene.lights = {beam};
  EXPECT_NEAR(flux(), 7 * 1.1 * 1.3, 3e-3 * 7 * 1.1 * 1.3);
  // What stands before the start takes nothing away; beyond it does.
  add_ball(scene, beam.position - beam.direction, 0.5);
  EXPECT_NEAR(flux(), 7 * 1.1 * 1.3, 3e-3 * 7 * 1.1 * 1.3);
  add_ball(scene, beam.position + beam.direction, 0.5);
  EXPECT_NEAR(flux(), 7 * (1.1 * 1.3 - pi * 0.25), 5e-3 * 7 * 1.1 * 1.3);
  // Fog dims it from the start plane on, if that is in the fog.
  scene.objects.resize(1);
  Medium fog;
  fog.sigma_t = Rgb<double>(0.2);
  fog.shape = Box{{-9, -1, -9}, {9, 999, 9}};
  scene.media = {fog};
  beam.cross_section = CrossSection::circle(0.1);  // all its light goes as far
  scene.lights = {beam};
  EXPECT_NEAR(flux() * std::exp(0.2 * 999), 7 * pi * 0.01 * std::exp(-0.2 * 3),
              0.03 * 7 * pi * 0.01);
}

// Shadow rays leave a surface a little above it, which may be before the start plane.
TEST(BeamsInScenes, light_what_lies_right_behind_their_start) {
  Scene scene;
  scene.resolution = {1, 1};
  scene.camera = {.position = {3, 4, 0}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 1};
  Mesh floor;
  floor.positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.objects.push_back({"floor", floor, {}});
  scene.objects[0].material.albedo = Rgb<double>(0.4);
  Collimated beam;
  beam.irradiance = Rgb<double>(7.);
  beam.direction = {0, -1, 0};
  beam.position = {0, 1e-5, 0};
  scene.lights = {beam};
  for (const Visibility visibility : {Visibility::embree, Visibility::analytic}) {
    scene.render.visibility = visibility;
    EXPECT_NEAR(render(scene).film.radiance(0, 0).g, 7 * 0.4 / pi, 1e-6);  // in float
  }
}

TEST(BeamsInScenes, with_an_image_are_refused_by_the_closed_form) {
  Scene scene = beam_in_a_box();
  scene.textures = {ramp({255, 255, 255})};
  std::get<Collimated>(scene.lights[0]).image = 0;
  scene.render.estimator = "closed_form";
  try {
    render(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "estimator closed_form cannot serve lights.0: closed_form is for beams without an "
                 "image; give the beam another outline instead");
  }
}

}  // namespace
}  // namespace airlight
