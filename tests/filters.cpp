// Glass and cut-outs: light through them and what the camera sees through them, every placement
// with every form, each channel against quadrature (support/brute_force.h).
#include <gtest/gtest.h>

#include "render/kernel.h"
#include "render/render.h"
#include "support/brute_force.h"
#include "support/stats.h"

namespace airlight {
namespace {

using test::BruteForce;
using test::CameraRay;
using test::Colour;
using test::Sheet;
using test::Vector;

constexpr int seeds = 80;

struct Case {
  const char* name;
  std::vector<Sheet> sheets;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  bool rgb = true;
};

/// Above the cube of fog, or inside it: light from above falls through.
Sheet above(double y, const Colour& tint, double opacity) {
  return {.corner = {-0.75, y, -3},
          .right = {1.5, 0, 0},
          .up = {0, 0, 6},
          .tint = tint,
          .opacity = [opacity](double, double) { return opacity; }};
}

/// Across the camera's view, in front of the fog or in it.
Sheet before(double z, const Colour& tint, double opacity) {
  return {.corner = {-3, -3, z},
          .right = {3.125, 0, 0},
          .up = {0, 6, 0},
          .tint = tint,
          .opacity = [opacity](double, double) { return opacity; }};
}

Material of_opacity(double opacity) {
  Material material;
  material.opacity = opacity;
  return material;
}

/// 4 x 4 texels, every other one clear. Bilinear interpolation crosses 1/2 on the texels' edges, so
/// that a cut-off there makes squares of them.
Case checker(const Colour& tint) {
  constexpr int n = 4;
  Texture squares{
      .width = n, .height = n, .rgba = {}, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const std::uint8_t alpha = (x + y) % 2 ? 255 : 0;
      squares.rgba.insert(squares.rgba.end(), {10, 20, 30, alpha});
    }
  Sheet sheet = above(1.5, tint, 1);
  sheet.opacity = [](double s, double t) {
    const int x = std::min(int(s * n), n - 1), y = n - 1 - std::min(int(t * n), n - 1);
    return (x + y) % 2 ? 1. : 0.;  // row 0 is on top
  };
  sheet.breaks = {0.25, 0.5, 0.75};
  Material cut;
  cut.opacity_texture = 0, cut.opacity_from_alpha = true, cut.cutoff = 0.5;
  return {"checker", {sheet}, {cut}, {squares}};
}

/// From a fifth to four fifths, linear between the two texels' centres, times 3/4; in red.
Case ramp() {
  const Texture texels{.width = 2,
                       .height = 1,
                       .rgba = {51, 0, 0, 255, 204, 0, 0, 255},
                       .srgb = false,
                       .wrap_u = Wrap::clamp,
                       .wrap_v = Wrap::clamp};
  Sheet sheet = above(1.5, {.9, .6, .3}, 1);
  sheet.opacity = [](double s, double) {
    return 0.75 * (0.2 + 0.6 * std::clamp((s - 0.25) / 0.5, 0., 1.));
  };
  sheet.breaks = {0.25, 0.75};
  Material material = of_opacity(0.75);
  material.opacity_texture = 0;
  return {"ramp", {sheet}, {material}, {texels}};
}

std::vector<Case> cases() {
  const Colour red(0.9, 0.3, 0.2), green(0.4, 0.8, 0.5);
  std::vector<Case> all = {
      {"tinted sheet", {above(1.5, red, 0)}, {of_opacity(0)}, {}},
      {"tinted sheet in the fog", {above(0.25, red, 0)}, {of_opacity(0)}, {}},
      {"grey fog under a tinted sheet", {above(0.25, red, 0)}, {of_opacity(0)}, {}, false},
      {"sheet of one opacity", {above(1.5, Colour(1.), 0.375)}, {of_opacity(0.375)}, {}},
      {"stacked sheets",
       {above(1.5, red, 0.25), above(0.5, green, 0), above(0.25, green, 0.5)},
       {of_opacity(0.25), of_opacity(0), of_opacity(0.5)},
       {}},
      checker(Colour(1.)),
      checker(green),
      ramp(),
      {"glass before the camera", {before(2, red, 0)}, {of_opacity(0)}, {}},
      {"glass in the fog", {before(0.25, red, 0.25)}, {of_opacity(0.25)}, {}},
      {"glass all around",
       {before(2, green, 0), before(0.25, red, 0.25), above(0.5, green, 0.5), before(-0.5, red, 0)},
       {of_opacity(0), of_opacity(0.25), of_opacity(0.5), of_opacity(0)},
       {}},
  };
  all[6].name = "stained checker";
  return all;
}

Scene scene_of(const Case& c) {
  Scene scene;
  scene.resolution = {8, 8};
  scene.camera = {.position = {0.3, 0.2, 3.6}, .target = {0.05, 0, 0}, .up = {0, 1, 0}, .fov = 30};
  Medium medium;
  medium.sigma_s = {0.25, 0.8, 1.5};
  medium.sigma_t = c.rgb ? Colour(0.3, 1, 2) : Colour(1.1);
  medium.emission = {0.05, 0.02, 0.01};
  medium.phase = HenyeyGreenstein{0.4};
  scene.media = {medium};
  scene.background = {0.3, 0.2, 0.1};
  scene.ambient = {0.05, 0.06, 0.07};
  Directional sun;
  sun.irradiance = {3, 2.5, 2};
  sun.direction = -normalize(Vector(0.3, 1, -0.2));
  scene.lights = {sun};
  scene.textures = c.textures;
  for (std::size_t i = 0; i < c.sheets.size(); ++i) {
    Sheet sheet = c.sheets[i];
    scene.objects.push_back(sheet.object("sheet", c.materials[i]));
  }
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  return scene;
}

struct Truth {
  Colour lit, open, glow, surface, transmittance;
};

Truth mean_truth(const Scene& scene, const Case& c) {
  const BruteForce truth(scene, c.sheets);
  const auto& sun = std::get<Directional>(scene.lights[0]);
  Truth mean;
  const double n = 1. / (scene.resolution.width * scene.resolution.height);
  for (int y = 0; y < scene.resolution.height; ++y)
    for (int x = 0; x < scene.resolution.width; ++x) {
      const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
      mean.lit += truth.in_scatter(ray) * n;
      // The sums without visibility leave out all sheets but the end of the ray, which none is.
      mean.open += truth.in_scatter(ray, sun, -sun.direction, false) * n;
      mean.glow += truth.emission(ray) * n;
      mean.surface += truth.surface(ray) * n;
      mean.transmittance += truth.transmittance(ray) * n;
    }
  return mean;
}

class EveryArithmetic : public testing::TestWithParam<const Kernel*> {};

TEST_P(EveryArithmetic, sees_light_through_glass_and_cut_outs) {
  // A film keeps floats, whatever the arithmetic; shadow edges are met by Embree in float.
  const double rounding = 5e-6;
  double worst = 0, least_seen = 0;
  for (const Case& c : cases()) {
    Scene scene = scene_of(c);
    const Truth truth = mean_truth(scene, c);
    Renderer renderer(scene);
    for (const char* estimator :
         {"equidistant+monte_carlo", "equidistant+ratio", "equidistant+difference",
          "distance+monte_carlo", "distance+ratio", "distance+difference",
          "whole_volume+monte_carlo", "whole_volume+ratio", "whole_volume+difference",
          "mix+monte_carlo", "mix+ratio", "mix+difference"}) {
      const std::string what = std::string(c.name) + ", " + estimator;
      RenderSettings settings = scene.render;
      settings.estimator = estimator;
      settings.isa = GetParam()->isa;
      settings.spp = 64;
      const bool ratio = what.ends_with("+ratio");
      std::array<std::array<std::vector<double>, 3>, 4> values;
      std::optional<Film> pooled;
      for (int seed = 0; seed < seeds; ++seed) {
        settings.seed = seed;
        const Rendered rendered = renderer.render(settings);
        ASSERT_EQ(rendered.rejected, 0) << what;
        pooled ? pooled->merge(rendered.film) : void(pooled.emplace(rendered.film));
        Estimate<double> mean;
        for (const auto& pixel : rendered.film.pixels()) mean += mean_estimate(pixel);
        mean = mean * (1. / 64);
        for (int k = 0; k < 3; ++k) {
          values[0][k].push_back(mean.plain[k]), values[1][k].push_back(mean.analytic[k]);
          values[2][k].push_back(mean.occluded[k]), values[3][k].push_back(mean.unoccluded[k]);
        }
      }
      const Colour want[4] = {ratio ? truth.glow : truth.glow + truth.lit, truth.open, truth.lit,
                              truth.open};
      const char* names[4] = {"plain", "analytic", "occluded", "unoccluded"};
      double largest_error = 0;
      for (int s = 0; s < (ratio ? 4 : 1); ++s)
        for (int k = 0; k < 3; ++k) {
          const double seen = test::relative_standard_error(values[s][k]);
          EXPECT_LT(seen, 5e-4) << names[s] << " cannot be judged: " << what;
          const double z = test::z_score(values[s][k], want[s][k], rounding * want[s][k]);
          EXPECT_LT(std::abs(z), 4) << names[s] << ", channel " << k << ", " << what;
          worst = std::max(worst, std::abs(z)), least_seen = std::max(least_seen, seen);
          largest_error = std::max(largest_error, seen);
        }
      // Pooled over all seeds, the bias of the quotient is far below what can be seen.
      Colour radiance;
      for (const auto& pixel : pooled->pixels())
        radiance += mean_estimate(pixel).radiance() * (1. / 64);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(radiance[k], (truth.lit + truth.glow)[k],
                    (4 * largest_error + 4 * rounding) * (truth.lit + truth.glow)[k])
            << "pooled, channel " << k << ", " << what;
    }
    // Surfaces, background and transmittance have no noise.
    const Film film = renderer.render(scene.render).film;
    Colour surface, transmittance;
    for (const auto& pixel : film.pixels()) {
      surface += Colour(pixel.surface) * (1 / pixel.sample_count() / 64.);
      transmittance += Colour(pixel.transmittance) * (1 / pixel.sample_count() / 64.);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(surface[k], truth.surface[k], 1e-5 * truth.surface[k]) << c.name;
      EXPECT_NEAR(transmittance[k], truth.transmittance[k], 1e-5) << c.name;
    }
  }
  std::printf("%s: largest |z| %.2f, largest relative standard error %.1e\n", GetParam()->name,
              worst, least_seen);
}

TEST_P(EveryArithmetic, both_ways_to_ask_see_the_same_glass) {
  for (const Case& c : cases()) {
    Scene scene = scene_of(c);
    scene.render.isa = GetParam()->isa;
    Renderer renderer(scene);
    const Film embree = renderer.render(scene.render).film;
    scene.render.visibility = Visibility::analytic;
    const Film analytic = renderer.render(scene.render).film;
    int different = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        for (int k = 0; k < 3; ++k)
          different += std::abs(embree.radiance(x, y)[k] - analytic.radiance(x, y)[k]) >
                       1e-5 * analytic.radiance(x, y)[k];
    EXPECT_LE(different, 6) << c.name;  // a sample on an edge may fall on either side
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryArithmetic, testing::ValuesIn(available_kernels()),
                         [](const auto& info) { return std::string(info.param->name); });

TEST(Filters, are_all_looked_through_however_many_stand_behind_each_other) {
  const Colour tint(0.995, 0.99, 0.985);
  constexpr double opacity = 1. / 256;
  constexpr int panes = 200;
  Case c{"panes", {}, {}, {}};
  const Scene open = scene_of(c);
  for (int i = 0; i < panes; ++i) {
    c.sheets.push_back(before(1.5 + 1.5 * i / panes, tint, opacity));
    c.materials.push_back(of_opacity(opacity));
    c.sheets.back().right = {6, 0, 0};
    c.sheets.back().albedo = {};
  }
  const Scene glazed = scene_of(c);
  Renderer plain(open), through_panes(glazed);
  for (const Kernel* kernel : available_kernels())
    for (const Visibility visibility : {Visibility::embree, Visibility::analytic}) {
      RenderSettings settings = open.render;
      settings.isa = kernel->isa;
      settings.visibility = visibility;
      const Film a = plain.render(settings).film, b = through_panes.render(settings).film;
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          for (int channel = 0; channel < 3; ++channel) {
            const double passes = std::pow((1 - opacity) * tint[channel], panes);
            const double want = passes * a.radiance(x, y)[channel];
            EXPECT_NEAR(b.radiance(x, y)[channel], want, 3e-5 * want)  // 200 products in float
                << kernel->name << " at " << x << "," << y;
          }
    }
}

}  // namespace
}  // namespace airlight
