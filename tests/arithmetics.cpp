// The same picture in every arithmetic: they agree to rounding, and none of them ever makes a
// number that is not finite, however the camera stands, the light falls and the fog lies.
#include <gtest/gtest.h>

#include "render/kernel.h"
#include "render/render.h"
#include "support/brute_force.h"

namespace airlight {
namespace {

using test::Colour;
using test::Sheet;
using test::Vector;

Directional sun(const Vector& toward, double diameter = 0) {
  Directional light;
  light.direction = -normalize(toward);
  light.irradiance = {3, 2.5, 2};
  light.angular_diameter = diameter;
  return light;
}

/// A ball and a shelf in fog.
Scene fog_scene(const Colour& sigma_t, const Shapes& shape = Box{}) {
  Scene scene;
  scene.resolution = {24, 16};
  scene.camera = {.position = {0.7, 0.9, 3.7}, .target = {0, -0.1, 0}, .up = {0, 1, 0}, .fov = 38};
  Medium medium;
  medium.sigma_t = sigma_t;
  medium.sigma_s = sigma_t * 0.75;
  medium.phase = HenyeyGreenstein{0.5};
  medium.emission = {0.002, 0.001, 0.003};
  medium.shape = shape;
  scene.media = {medium};
  scene.background = {0.3, 0.2, 0.1};
  scene.ambient = {0.05, 0.06, 0.07};
  scene.lights = {sun({0.4, 1, 0.3})};
  Material red;
  red.albedo = {0.8, 0.3, 0.2};
  scene.objects = {{"ball", Sphere{{-0.25, -0.25, 0}, 0.4}, red},
                   Sheet{.corner = {0.125, 0.1875, -0.5},
                         .right = {0.625, 0.125, 0},
                         .up = {0, 0, 0.75},
                         .albedo = {.9, .1, .4}}
                       .object("shelf")};
  scene.render.spp = 16;
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  return scene;
}

/// A regular octahedron about the origin.
Convex octahedron() {
  Convex result;
  const double s = 1 / std::sqrt(3.);
  for (double x : {-s, s})
    for (double y : {-s, s})
      for (double z : {-s, s})
        result.faces[std::size_t(result.face_count++)] = {Vector(x, y, z), 0.9};
  return result;
}

/// Renders in one arithmetic and demands that every number of every layer is finite.
Film render(const Scene& scene, const Kernel& kernel, const std::string& what) {
  RenderSettings settings = scene.render;
  settings.isa = kernel.isa;
  Rendered rendered = Renderer(scene).render(settings);
  EXPECT_EQ(rendered.rejected, 0) << what << ", " << kernel.name;
  // The closed form less what is shadowed may fall below zero by chance.
  const bool signed_noise = scene.render.estimator.ends_with("+difference");
  for (const char* layer : {"beauty", "standard_error"}) {
    const Image image = rendered.film.layer(layer);
    int bad = 0;
    for (float value : image.pixels) bad += !(std::isfinite(value) && (signed_noise || value >= 0));
    EXPECT_EQ(bad, 0) << what << ", " << layer << ", " << kernel.name;
  }
  return std::move(rendered.film);
}

struct Agreement {
  double most = 0;     ///< relative difference that nine tenths of all channels stay below
  double apart = 0;    ///< the part of all that differs by more than 1e-4
  double picture = 0;  ///< relative difference of the mean
};

Agreement compare(const Film& film, const Film& reference) {
  std::vector<double> differences;
  Colour a, b;
  for (int y = 0; y < film.crop.height; ++y)
    for (int x = 0; x < film.crop.width; ++x) {
      const Colour p = film.radiance(x, y), q = reference.radiance(x, y);
      a += p, b += q;
      for (int c = 0; c < 3; ++c)
        differences.push_back(p[c] == q[c] ? 0 : std::abs(p[c] - q[c]) / std::max(p[c], q[c]));
    }
  std::ranges::sort(differences);
  Agreement result;
  result.most = differences[differences.size() * 9 / 10];
  result.apart = double(std::ranges::count_if(differences, [](double d) { return d > 1e-4; })) /
                 double(differences.size());
  for (int c = 0; c < 3; ++c)
    result.picture = std::max(result.picture, std::abs(a[c] - b[c]) / std::max(b[c], 1e-30));
  return result;
}

struct Limits {
  double most = 3e-6;
  double apart = 0.004;  // a shadow ray may fall on the other side of an edge in one pixel of 250
  double picture = 2e-5;
};

void expect_agreement(const Scene& scene, const std::string& what, const Limits& limits = {}) {
  Agreement worst;
  for (const char* estimator : {"rewv", "mcwvds", "rm", "distance+difference", "mix+ratio"}) {
    Scene variant = scene;
    variant.render.estimator = estimator;
    const auto kernels = available_kernels();
    const Film reference = render(variant, *kernels.front(), what);
    for (std::size_t i = 1; i < kernels.size(); ++i) {
      const std::string where = what + ", " + estimator + ", " + kernels[i]->name;
      const Agreement a = compare(render(variant, *kernels[i], what), reference);
      EXPECT_LT(a.most, limits.most) << where;
      EXPECT_LE(a.apart, limits.apart) << where;
      EXPECT_LT(a.picture, limits.picture) << where;
      worst = {std::max(worst.most, a.most), std::max(worst.apart, a.apart),
               std::max(worst.picture, a.picture)};
    }
  }
  std::printf("%s: nine tenths within %.1e, %.1e beyond 1e-4, picture %.1e\n", what.c_str(),
              worst.most, worst.apart, worst.picture);
}

TEST(Arithmetics, agree_in_every_shape) {
  expect_agreement(fog_scene(Colour(1.)), "grey box");
  expect_agreement(fog_scene({0.3, 1, 3}), "RGB box");
  const Box turned{.min = {-0.8, -1.1, -0.6}, .max = {1, 0.9, 1.3}, .rotation = {20, -35, 50}};
  expect_agreement(fog_scene({0.3, 1, 3}, turned), "turned box");
  expect_agreement(fog_scene(Colour(1.), octahedron()), "grey octahedron");
  expect_agreement(fog_scene({0.3, 1, 3}, octahedron()), "RGB octahedron");
  Scene dark = fog_scene({0.3, 1, 3}, Unbounded{});
  dark.lights.clear();
  expect_agreement(dark, "without end");
}

TEST(Arithmetics, agree_with_the_camera_inside) {
  Scene scene = fog_scene({0.3, 1, 3});
  scene.camera = {.position = {0.3, 0.2, 0.8}, .target = {0, -0.2, -1}, .fov = 80};
  expect_agreement(scene, "box");
  scene.media[0].shape = octahedron();
  expect_agreement(scene, "octahedron");
}

TEST(Arithmetics, agree_in_rays_spread_over_pixels_and_discs) {
  Scene scene = fog_scene({0.3, 1, 3});
  scene.lights = {sun({0.4, 1, 0.3}, 0.53), sun({-0.8, 0.7, 0.4}, 3)};
  scene.render.samples_per_ray = 4;
  expect_agreement(scene, "discs",
                   {.apart = 0.01});  // more directions a pixel, more of them near an edge
  for (PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian}) {
    scene.lights = {sun({0.4, 1, 0.3})};
    scene.render.filter = filter;
    expect_agreement(scene, "filter", {.apart = 0.01});
  }
}

TEST(Arithmetics, agree_in_thin_fog_and_dense) {
  expect_agreement(fog_scene(Colour(1e-4)), "thin");
  expect_agreement(fog_scene({1e-4, 1e-3, 1e-2}), "thin, RGB");
  // A float knows an optical depth of 300 to 4e-5, and so much of what passes; in blue, 450.
  expect_agreement(fog_scene(Colour(100.)), "dense", {.most = 2e-4, .apart = 0.1});
  expect_agreement(fog_scene({50, 100, 150}), "dense, RGB", {.most = 2e-4, .apart = 0.1});
}

TEST(Arithmetics, agree_from_a_kilometre_away) {
  Scene scene = fog_scene({0.3, 1, 3});
  const Vector away = normalize(Vector(0.7, 0.9, 3.7));
  scene.camera = {.position = away * 1000, .target = {0, -0.1, 0}, .fov = 0.15};
  // Floats of a thousand metres are 6e-5 m apart, and so are hits and entries; times sigma = 3 that
  // is 2e-4 of what passes.
  expect_agreement(scene, "far away", {.most = 3e-4, .apart = 0.15, .picture = 2e-4});
}

/// Where things coincide: nothing to compare with but every other arithmetic.
struct Degenerate {
  const char* name;
  Camera camera;
  Vector toward;
};

std::vector<Degenerate> degenerates() {
  const Vector oblique(0.4, 1, 0.3), up(0, 1, 0), side(1, 0, 0);
  std::vector<Degenerate> all;
  for (const Vector& toward :
       {oblique, up, side, Vector(0, 0, 1), Vector(0, 0, -1), -up, Vector(1, 1, 0),
        Vector(1, 1e-9, 0), Vector(1e-7, 1, 1e-12), Vector(1, 1e-3, 0)}) {
    all.push_back(
        {"on a face, looking in", {.position = {0.25, 0.5, 1}, .target = {0, 0, 0}}, toward});
    all.push_back({"on a face, looking out", {.position = {0, 0, 1}, .target = {0, 0, 5}}, toward});
    all.push_back(
        {"on a face, looking along it", {.position = {0, 1, 0.5}, .target = {0, 1, -5}}, toward});
    all.push_back(
        {"before a face, looking along it", {.position = {0, 1, 5}, .target = {0, 1, -5}}, toward});
    all.push_back(
        {"at a corner, looking in", {.position = {1, 1, 1}, .target = {-1, -1, -1}}, toward});
    all.push_back(
        {"at a corner, looking out", {.position = {1, 1, 1}, .target = {3, 2, 1.5}}, toward});
    all.push_back({"at a corner, along an edge",
                   {.position = {1, 1, 1}, .target = {1, 1, -1}, .up = {1, 0, 0}},
                   toward});
    all.push_back({"along an edge from afar",
                   {.position = {1, 1, 6}, .target = {1, 1, -1}, .up = {1, 0, 0}, .fov = 1e-3},
                   toward});
    all.push_back({"along the light",
                   {.position = toward * 4, .target = {0, 0, 0}, .up = {0.1, 0.2, 0.9}},
                   toward});
    all.push_back({"against the light",
                   {.position = toward * -4, .target = {0, 0, 0}, .up = {0.1, 0.2, 0.9}},
                   toward});
    all.push_back({"past a corner",
                   {.position = {1, 1, 6}, .target = {1, 1, 1}, .up = {0, 1, 0}, .fov = 1e-4},
                   toward});
    all.push_back({"in the middle of the ball",
                   {.position = {-0.25, -0.25, 0}, .target = {0, 0, 1}},
                   toward});
  }
  return all;
}

TEST(Arithmetics, make_no_bad_numbers_where_things_coincide) {
  for (const Degenerate& d : degenerates())
    for (const Colour& sigma : {Colour(1.), Colour(0.3, 1, 3), Colour(100.), Colour(0.)})
      for (double diameter : {0., 0.53, 3.}) {
        Scene scene = fog_scene(sigma);
        scene.resolution = {7, 5};  // the middle pixel looks straight ahead
        scene.camera = d.camera;
        scene.lights = {sun(d.toward, diameter)};
        scene.render.spp = 4;
        for (const char* estimator : {"rewv", "mcds", "rm", "mix+difference"}) {
          scene.render.estimator = estimator;
          const std::string what =
              std::string(d.name) + ", light from " + std::to_string(d.toward.x) + "," +
              std::to_string(d.toward.y) + "," + std::to_string(d.toward.z) + ", disc " +
              std::to_string(diameter) + ", sigma " + std::to_string(sigma.g) + ", " + estimator;
          for (const Kernel* kernel : available_kernels()) render(scene, *kernel, what);
        }
      }
}

TEST(Arithmetics, make_no_bad_numbers_of_extreme_media) {
  for (const Shapes& shape : {Shapes(Box{}), Shapes(octahedron())})
    for (const Colour& sigma : {Colour(0.), Colour(1e-30), Colour(1e4), Colour(1e7),
                                Colour(0, 1, 1e5), Colour(1e3, 2e3, 3e3)})
      for (double diameter : {0., 0.53, 3.})
        for (const Vector& toward : {Vector(0.4, 1, 0.3), Vector(1, 0, 0), Vector(1, 2e-3, 0)})
          for (const Colour& light : {Colour(1.), Colour(0, 0, 1), Colour(0.)}) {
            Scene scene = fog_scene(sigma, shape);
            scene.resolution = {7, 5};
            scene.lights = {sun(toward, diameter)};
            std::get<Directional>(scene.lights[0]).irradiance = light;
            scene.render.spp = 4;
            for (const char* estimator : {"rewv", "mcds", "rm", "mix+difference"}) {
              scene.render.estimator = estimator;
              const std::string what = "sigma " + std::to_string(sigma.g) + ", disc " +
                                       std::to_string(diameter) + ", light " +
                                       std::to_string(light.r) + ", toward y " +
                                       std::to_string(toward.y) + ", " + estimator;
              for (const Kernel* kernel : available_kernels()) render(scene, *kernel, what);
            }
          }
}

}  // namespace
}  // namespace airlight
