// What surfaces send to the camera, through fog and without, against hand-derived numbers and
// against a plain double of the whole (support/brute_force.h), in every arithmetic.
#include <gtest/gtest.h>

#include <numbers>

#include "render/kernel.h"
#include "render/render.h"
#include "support/brute_force.h"
#include "support/worst.h"

namespace airlight {
namespace {

using std::numbers::pi;
using test::BruteForce;
using test::CameraRay;
using test::Colour;
using test::Sheet;
using test::Vector;

/// A pixel that looks down -z from (0, 0, 5).
Scene one_pixel() {
  Scene scene;
  scene.resolution = {1, 1};
  scene.camera = {.position = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 1};
  scene.render.estimator = "rewv";
  scene.render.spp = 4;
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  return scene;
}

Medium fog(Colour sigma_s, Colour sigma_t) {
  Medium medium;
  medium.sigma_s = sigma_s, medium.sigma_t = sigma_t;
  return medium;
}

Directional sun(const Vector& toward, const Colour& irradiance) {
  Directional light;
  light.direction = -normalize(toward);
  light.irradiance = irradiance;
  return light;
}

/// A square of side 8 across the z axis.
Sheet wall_at(double z, const Colour& albedo) {
  return {.corner = {-4, -4, z}, .right = {8, 0, 0}, .up = {0, 8, 0}, .albedo = albedo};
}

class EveryArithmetic : public testing::TestWithParam<const Kernel*> {
 protected:
  Film render(Scene& scene) const {
    scene.render.isa = GetParam()->isa;
    const Rendered rendered = Renderer(scene).render(scene.render);
    EXPECT_EQ(rendered.rejected, 0);
    return rendered.film;
  }

  /// What one pixel may be off for rounding: a film keeps floats, and floats compute.
  double rounding() const { return GetParam()->isa == InstructionSet::reference ? 2e-7 : 3e-6; }

  void expect_colour(const Colour& got, const Colour& want, const char* what) const {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(got[c], want[c], rounding() * std::abs(want[c]) + 1e-12)
          << what << ", channel " << c;
  }
  void expect_layer(const Film& film, const char* layer, const Colour& want) const {
    const Image image = film.layer(layer);
    const float* p = image.row(0).data();
    expect_colour({p[0], p[1], p[2]}, want, layer);
  }
};

TEST_P(EveryArithmetic, a_wall_without_fog_reflects_albedo_over_pi) {
  Scene scene = one_pixel();
  scene.objects = {wall_at(-2, {0.2, 0.5, 0.8}).object("wall")};
  scene.lights = {sun({0, std::sqrt(3), 1}, {3, 2, 1})};  // 60 degrees off the normal
  const Film film = render(scene);
  expect_colour(film.radiance(0, 0), Colour(0.2 * 3, 0.5 * 2, 0.8) * (0.5 / pi), "radiance");
  expect_layer(film, "beauty", Colour(0.2 * 3, 0.5 * 2, 0.8) * (0.5 / pi));
  expect_layer(film, "in_scatter", {});
  expect_layer(film, "albedo", {0.2, 0.5, 0.8});
  expect_layer(film, "normal", {0, 0, 1});
  expect_layer(film, "transmittance", Colour());  // the wall hides all that is behind it
  EXPECT_NEAR(film.pixel(0).depth, 7, 7 * 1e-6);
  EXPECT_EQ(film.pixel(0).object, 1);
}

TEST_P(EveryArithmetic, a_wall_inside_the_fog_is_dimmed_on_both_legs) {
  Scene scene = one_pixel();
  scene.media = {fog(Colour(0.), {0.3, 1, 3})};
  scene.objects = {wall_at(-0.5, Colour(0.6)).object("wall")};
  scene.lights = {sun({0, 0, 1}, Colour(2.))};
  // The camera leg from z = 1 to -0.5 is 1.5 m, and so is the light's.
  const Colour want = test::exp_of({0.3, 1, 3}, 3) * (0.6 * 2 / pi);
  expect_colour(render(scene).radiance(0, 0), want, "radiance");
}

TEST_P(EveryArithmetic, a_wall_beyond_the_fog_is_seen_and_lit_through_all_of_it) {
  Scene scene = one_pixel();
  scene.media = {fog(Colour(0.), {0.3, 1, 3})};
  scene.objects = {wall_at(-3, Colour(0.6)).object("wall")};
  scene.lights = {sun({0, 0, 1}, Colour(2.))};
  const Film film = render(scene);
  expect_colour(film.radiance(0, 0), test::exp_of({0.3, 1, 3}, 4) * (0.6 * 2 / pi), "radiance");
  expect_layer(film, "transmittance", Colour());
}

TEST_P(EveryArithmetic, a_camera_in_the_fog_sees_a_shorter_leg) {
  Scene scene = one_pixel();
  scene.camera.position = {0, 0, 0.25};
  scene.media = {fog(Colour(0.), Colour(0.8))};
  scene.objects = {wall_at(-0.5, Colour(0.6)).object("wall")};
  scene.lights = {sun({0, 0, 1}, Colour(2.))};
  // Light comes from behind the camera: 0.75 m to the eye, 1.5 m from the light. Nobody sees the
  // camera.
  expect_colour(render(scene).radiance(0, 0), Colour(0.6 * 2 / pi * std::exp(-0.8 * 2.25)),
                "radiance");
}

TEST_P(EveryArithmetic, a_camera_in_the_fog_looks_out_of_it) {
  Scene scene = one_pixel();
  scene.camera.position = {0, 0, 0.25};
  scene.media = {fog(Colour(0.), Colour(0.8))};
  scene.background = {1, 2, 3};
  expect_colour(render(scene).radiance(0, 0), Colour(1, 2, 3) * std::exp(-0.8 * 1.25), "radiance");
}

TEST_P(EveryArithmetic, ambient_light_reaches_surfaces_whole_and_no_fog) {
  Scene scene = one_pixel();
  scene.media = {fog(Colour(0.5), Colour(0.5))};
  scene.ambient = {1, 2, 3};
  scene.objects = {wall_at(-0.5, {0.6, 0.3, 0.1}).object("wall")};
  const Film film = render(scene);
  expect_colour(film.radiance(0, 0), Colour(0.6, 0.6, 0.3) * std::exp(-0.75), "radiance");
  expect_layer(film, "in_scatter", {});
}

TEST_P(EveryArithmetic, the_background_is_seen_through_the_fog) {
  Scene scene = one_pixel();
  scene.media = {fog(Colour(0.), {0.3, 1, 3})};
  scene.background = {1, 2, 3};
  const Film film = render(scene);
  expect_colour(film.radiance(0, 0), test::exp_of({0.3, 1, 3}, 2) * Colour(1, 2, 3), "radiance");
  expect_layer(film, "albedo", {});
  expect_layer(film, "normal", {});
  EXPECT_EQ(film.pixel(0).depth, 0);
  EXPECT_EQ(film.pixel(0).object, 0);
}

TEST_P(EveryArithmetic, fog_glows_up_to_the_first_surface) {
  for (double z : {-0.5, -3.}) {  // inside, beyond
    Scene scene = one_pixel();
    scene.media = {fog(Colour(0.), {0.3, 1e-9, 3})};
    scene.media[0].emission = {0.1, 0.2, 0.3};
    scene.objects = {wall_at(z, Colour(0.)).object("wall")};
    const double s = z > -1 ? 1.5 : 2;
    const Colour want(0.1 * (1 - std::exp(-0.3 * s)) / 0.3, 0.2 * s,
                      0.3 * (1 - std::exp(-3 * s)) / 3);
    expect_colour(render(scene).radiance(0, 0), want, "radiance");
  }
}

TEST_P(EveryArithmetic, glowing_fog_that_a_ray_misses_adds_nothing) {
  for (const Vector& camera : {Vector(0, 0, 5), Vector(3, 0, 5), Vector(1.5, 1.5, 5)}) {
    Scene scene = one_pixel();
    scene.resolution = {8, 8};
    scene.camera = {.position = camera, .target = camera + Vector(0, 0, 1)};  // looking away
    scene.media = {fog(Colour(0.5), Colour(40.))};
    scene.media[0].emission = {0.1, 0.2, 0.3};
    scene.background = {1, 2, 3};
    scene.lights = {sun({0, 1, 1}, Colour(2.))};
    const Film film = render(scene);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) expect_colour(film.radiance(x, y), {1, 2, 3}, "radiance");
  }
}

TEST_P(EveryArithmetic, lights_add_up) {
  Scene scene = one_pixel();
  scene.media = {fog({0.2, 0.1, 0.3}, {0.3, 1, 3})};
  scene.objects = {wall_at(-0.5, Colour(0.6)).object("wall")};
  const Directional suns[] = {sun({1, 2, 3}, {3, 2, 1}), sun({-1, 0.2, 2}, {0, 1, 2})};
  Colour separate;
  for (const Directional& light : suns) {
    scene.lights = {light};
    separate += render(scene).radiance(0, 0);
  }
  scene.lights = {suns[0], suns[1]};
  expect_colour(render(scene).radiance(0, 0), separate, "radiance");
}

TEST_P(EveryArithmetic, a_sheet_shows_the_light_of_the_viewers_side_only) {
  for (double side : {1., -1.}) {
    for (bool turned : {false, true}) {
      Scene scene = one_pixel();
      Sheet sheet = wall_at(0, Colour(0.6));
      if (turned) std::swap(sheet.right, sheet.up);  // its own normal then points away
      scene.objects = {sheet.object("sheet")};
      scene.lights = {sun({0, 0, side}, Colour(2.))};
      const Film film = render(scene);
      expect_colour(film.radiance(0, 0), Colour(side > 0 ? 0.6 * 2 / pi : 0.), "radiance");
      expect_layer(film, "normal", {0, 0, 1});
    }
  }
}

TEST_P(EveryArithmetic, a_shadow_is_black_but_for_ambient_light) {
  Scene scene = one_pixel();
  Sheet awning{.corner = {-9, 3, -9}, .right = {18, 0, 0}, .up = {0, 0, 18}};
  scene.objects = {wall_at(-2, Colour(0.6)).object("wall"), awning.object("awning")};
  scene.lights = {sun({0, 1, 1}, Colour(2.))};
  scene.ambient = Colour(0.25);
  expect_colour(render(scene).radiance(0, 0), Colour(0.6 * 0.25), "radiance");
}

TEST_P(EveryArithmetic, normals_of_a_mesh_shade_it) {
  Scene scene = one_pixel();
  Object wall = wall_at(-2, Colour(0.6)).object("wall");
  const Vector n = normalize(Vector(0, 1, 2));
  std::get<Mesh>(wall.geometry).normals.assign(4, Vec3<float>(n));
  scene.objects = {wall};
  scene.lights = {sun({1, 1, 1}, Colour(2.))};
  const Film film = render(scene);
  expect_colour(film.radiance(0, 0), Colour(0.6 * 2 / pi * dot(n, normalize(Vector(1, 1, 1)))),
                "radiance");
  expect_layer(film, "normal", {n.x, n.y, n.z});
}

TEST_P(EveryArithmetic, a_sphere_is_lit_by_its_cosine) {
  Scene scene = one_pixel();
  scene.resolution = {16, 16};
  scene.camera.fov = 20;
  const Vector centre(0.1, -0.05, 0), toward = normalize(Vector(1, 2, 3));
  Material material;
  material.albedo = Colour(0.6);
  scene.objects = {{"ball", Sphere{centre, 0.7}, material}};
  scene.lights = {sun(toward, Colour(2.))};
  const Film film = render(scene);
  int seen = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
      const Vector q = ray.origin - centre;
      const double b = dot(q, ray.direction), disc = b * b - dot(q, q) + 0.7 * 0.7;
      if (std::abs(disc) < 0.05) continue;  // near the rim a hit in float is known to 1e-5 only
      const Vector n = (q + ray.direction * (-b - std::sqrt(std::max(disc, 0.)))) * (1 / 0.7);
      const double want = disc > 0 ? 0.6 * 2 / pi * std::max(dot(n, toward), 0.) : 0;
      seen += want > 0;
      // The normal of a sphere goes through two angles in float.
      EXPECT_NEAR(film.radiance(x, y).g, want, 4e-6) << x << "," << y;
    }
  EXPECT_GT(seen, 20);
}

/// A room in fog: a floor, a wall behind, two shelves that cast shadows, two lights, everything on.
struct Room {
  std::vector<Sheet> sheets;
  Scene scene;

  explicit Room(bool with_fog, bool camera_inside) {
    scene = one_pixel();
    scene.resolution = {24, 20};
    scene.camera = camera_inside
                       ? Camera{.position = {0.3, 0.2, 0.8}, .target = {0, -0.2, -1}, .fov = 80}
                       : Camera{.position = {0.7, 0.9, 3.7}, .target = {0, -0.1, 0}, .fov = 38};
    if (with_fog) {
      scene.media = {fog({0.2, 0.4, 0.9}, {0.3, 0.7, 1.6})};
      scene.media[0].emission = {0.02, 0.01, 0.03};
      scene.media[0].phase = HenyeyGreenstein{0.5};
    }
    scene.background = {0.3, 0.2, 0.1};
    scene.ambient = {0.05, 0.06, 0.07};
    scene.lights = {sun({0.4, 1, 0.3}, {3, 2.5, 2}), sun({-0.8, 0.7, 0.4}, {0.5, 1, 2})};
    sheets = {
        // corners that a mesh's floats hold exactly
        {.corner = {-3, -0.8125, -3},
         .right = {0, 0, 4.5},
         .up = {6, 0, 0},
         .albedo = {.7, .6, .5}},
        {.corner = {-1, -0.8125, -1.5},
         .right = {1.375, 0, 0},
         .up = {0, 2, 0.125},
         .albedo = {.2, .5, .8}},
        {.corner = {0.125, 0.1875, -0.5},
         .right = {0.625, 0.125, 0},
         .up = {0, 0, 0.75},
         .albedo = {.9, .1, .4}},
        {.corner = {-0.8125, -0.3125, -0.1875},
         .right = {0.5, 0, 0.1875},
         .up = {-.1875, 0.1875, 0.5},
         .albedo = {.5, .5, .1}},
    };
    const char* names[] = {"floor", "wall", "shelf", "tray"};
    for (std::size_t i = 0; i < sheets.size(); ++i)
      scene.objects.push_back(sheets[i].object(names[i]));
  }
};

TEST_P(EveryArithmetic, rooms_agree_with_brute_force) {
  for (bool with_fog : {false, true})
    for (bool inside : {false, true})
      for (Visibility visibility : {Visibility::embree, Visibility::analytic}) {
        Room room(with_fog, inside);
        Scene& scene = room.scene;
        scene.render.visibility = visibility;
        const BruteForce truth(scene, room.sheets);
        const Film film = render(scene);
        const Image surface = film.layer("surface"), transmittance = film.layer("transmittance"),
                    normal = film.layer("normal"), albedo = film.layer("albedo");
        int wrong = 0;
        for (int y = 0; y < film.crop.height; ++y)
          for (int x = 0; x < film.crop.width; ++x) {
            const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
            const Colour want = truth.surface(ray), through = truth.transmittance(ray);
            const auto [depth, first] = truth.first(ray);
            bool same = true;
            for (int c = 0; c < 3; ++c) {
              same = same && std::abs(surface.row(y)[3 * x + c] - want[c]) < 2e-5 * want[c] + 1e-9;
              same = same && std::abs(transmittance.row(y)[3 * x + c] - through[c]) < 1e-5;
              const double a = first ? first->albedo[c] : 0;
              same = same && std::abs(albedo.row(y)[3 * x + c] - a) < 1e-6;
              Vector n = first ? first->normal() : Vector();
              if (dot(n, ray.direction) > 0) n = -n;
              same = same && std::abs(normal.row(y)[3 * x + c] - n[c]) < 1e-6;
            }
            const auto& pixel = film.pixel(std::size_t(y * film.crop.width + x));
            const int id = first ? int(std::find_if(room.sheets.begin(), room.sheets.end(),
                                                    [&, s = first](const Sheet& sheet) {
                                                      return sheet.normal() == s->normal();
                                                    }) -
                                       room.sheets.begin()) +
                                       1
                                 : 0;
            same = same && std::abs(pixel.depth - depth) < 1e-5 * depth + 1e-9;
            same = same && pixel.object == float(id);
            wrong += !same;
          }
        // A pixel whose ray or shadow ray passes an edge within rounding, or within the lift of
        // shadow rays off the surface, may fall on the other side.
        EXPECT_LE(wrong, 3) << (with_fog ? "fog" : "no fog") << (inside ? ", inside" : ", outside");
      }
}

TEST(ClosedFormRoom, agrees_with_brute_force_in_every_sum) {
  for (bool inside : {false, true}) {
    Room room(true, inside);
    Scene& scene = room.scene;
    scene.render.estimator = "closed_form";
    scene.render.visibility = Visibility::analytic;
    const BruteForce truth(scene, room.sheets);
    const Film film = Renderer(scene).render(scene.render).film;
    test::Worst worst("in-scatter of a room in closed form, relative");
    for (int y = 0; y < film.crop.height; y += 3)
      for (int x = 0; x < film.crop.width; x += 3) {
        const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
        const Colour want = truth.in_scatter(ray) + truth.emission(ray);
        const Colour got = mean_estimate(film.pixel(std::size_t(y * film.crop.width + x))).plain;
        for (int c = 0; c < 3; ++c)
          worst.see(std::abs(got[c] - want[c]) / (want[c] + 1e-6),
                    std::to_string(x) + "," + std::to_string(y));
      }
    worst.expect_below(1e-6);  // a film keeps floats
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryArithmetic, testing::ValuesIn(available_kernels()),
                         [](const auto& info) { return std::string(info.param->name); });

}  // namespace
}  // namespace airlight
