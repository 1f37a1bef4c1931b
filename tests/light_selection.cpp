// Samples that ask one light each: the sums stay what they are when every sample asks every light,
// for each placement and form, and what is picked by the closed form has less noise.

#include <gmock/gmock.h>

#include "error.h"
#include "image/metrics.h"
#include "render/kernel.h"
#include "render/probe.h"
#include "render/render.h"
#include "support/stats.h"

namespace airlight {
namespace {

using Vector = Vec3<double>;

/// A ball in a box of fog in the light of two suns and two beams.
Scene four_lights(bool rgb) {
  Scene scene;
  scene.resolution = {16, 16};
  scene.camera = {.position = {0.3, 0.5, 3.4}, .target = {0.05, 0, 0}, .up = {0, 1, 0}, .fov = 30};
  Medium fog;
  fog.sigma_s = rgb ? Rgb<double>(0.25, 0.8, 2.1) : Rgb<double>(0.8);
  fog.sigma_t = rgb ? Rgb<double>(0.3, 1, 3) : Rgb<double>(1.1);
  fog.phase = HenyeyGreenstein{0.4};
  scene.media = {fog};
  const auto sun = [](const Vector& toward, const Rgb<double>& irradiance) {
    Directional light;
    light.irradiance = irradiance, light.direction = -normalize(toward);
    return light;
  };
  const auto beam = [](const Vector& from, const Vector& to, double radius,
                       const Rgb<double>& irradiance) {
    Collimated light;
    light.irradiance = irradiance, light.position = from, light.direction = normalize(to - from);
    orthonormal_basis(light.direction, light.right, light.up);
    light.cross_section = CrossSection::circle(radius);
    return light;
  };
  scene.lights = {sun({0.35, 1, -0.2}, {3, 2.5, 2}), sun({-1, 0.3, 0.4}, {0.1, 0.2, 0.3}),
                  beam({0.7, 2, 0}, {0.3, 0, 0.2}, 0.3, {9, 1, 2}),
                  beam({-0.6, 0.6, 0.3}, {0.2, -0.5, 0}, 0.25, {1, 12, 4})};
  Material black;
  black.albedo = Rgb<double>(0.);
  scene.objects.push_back({"ball", Sphere{{0, 0, 0}, 0.45}, black});
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  scene.render.visibility = Visibility::analytic;
  return scene;
}

Film closed_form(const Scene& scene) {
  RenderSettings settings = scene.render;
  settings.estimator = "closed_form";
  settings.spp = 1;
  settings.light_selection = LightSelection::all;
  return Renderer(scene).render(settings).film;
}

Estimate<double> mean_over_picture(const Film& film) {
  Estimate<double> sum;
  for (const PixelSums& pixel : film.pixels()) sum += mean_estimate(pixel);
  return sum * (1. / double(film.pixel_count()));
}

/// The picture's mean without the ball's shadow, seen in front of the ball as before.
Rgb<double> open_mean(const Scene& scene) {
  RenderSettings settings = scene.render;
  settings.estimator = "rewv";  // its analytic sum knows no shadows and has no noise
  settings.spp = 1;
  settings.isa = InstructionSet::reference;
  return mean_over_picture(Renderer(scene).render(settings).film).analytic;
}

constexpr LightSelection picking[] = {LightSelection::unoccluded, LightSelection::uniform};
const char* name_of(LightSelection s) {
  return s == LightSelection::uniform ? "uniform" : "unoccluded";
}

TEST(LightSelection, leaves_every_sum_what_it_is) {
  constexpr int seeds = 64;
  double worst = 0;
  for (const bool rgb : {false, true}) {
    Scene scene = four_lights(rgb);
    const Rgb<double> lit = mean_over_picture(closed_form(scene)).plain, open = open_mean(scene);
    ASSERT_LT(lit.g, 0.98 * open.g);
    Renderer renderer(scene);
    const auto judge = [&](const auto& placement, const auto& form, LightSelection selection,
                           InstructionSet isa) {
      RenderSettings settings = scene.render;
      settings.estimator = std::string(placement.name) + "+" + form.name;
      settings.light_selection = selection;
      settings.isa = isa;
      settings.spp = 256;
      const Estimate<double> want = form(open, lit, open);
      const Rgb<double> sums[4] = {want.plain, want.analytic, want.occluded, want.unoccluded};
      std::array<std::array<std::vector<double>, 3>, 4> values;
      for (int seed = 0; seed < seeds; ++seed) {
        settings.seed = seed;
        const Rendered rendered = renderer.render(settings);
        ASSERT_EQ(rendered.rejected, 0);
        const Estimate<double> e = mean_over_picture(rendered.film);
        const Rgb<double> found[4] = {e.plain, e.analytic, e.occluded, e.unoccluded};
        for (int s = 0; s < 4; ++s)
          for (int k = 0; k < 3; ++k) values[s][k].push_back(found[s][k]);
      }
      for (int s = 0; s < 4; ++s)
        for (int k = 0; k < 3; ++k) {
          if (sums[s][k] == 0) {
            EXPECT_THAT(values[s][k], testing::Each(0));
            continue;
          }
          EXPECT_LT(test::relative_standard_error(values[s][k]), 1e-3)
              << settings.estimator << " " << name_of(selection);
          const double z = test::z_score(values[s][k], sums[s][k], 3e-6 * sums[s][k]);
          EXPECT_LT(std::abs(z), 4) << settings.estimator << " " << name_of(selection) << ", sum "
                                    << s << ", channel " << k << (rgb ? ", RGB" : ", grey");
          worst = std::max(worst, std::abs(z));
        }
    };
    const auto each_form = [&](const auto& placement, InstructionSet isa) {
      for (const LightSelection selection : picking) {
        judge(placement, MonteCarlo{}, selection, isa);
        judge(placement, Ratio{}, selection, isa);
        judge(placement, Difference{}, selection, isa);
      }
    };
    each_form(Equidistant{}, InstructionSet::best);
    each_form(Distance{}, InstructionSet::best);
    each_form(WholeVolume{}, InstructionSet::best);
    each_form(Mixed{}, InstructionSet::best);
    each_form(WholeVolume{}, InstructionSet::reference);
  }
  std::printf("[ measured ] worst z of a sum: %.2f\n", worst);
}

TEST(LightSelection, by_the_closed_form_has_no_noise_where_nothing_is_shadowed) {
  // Of the same colour in grey fog in any form; else where the closed form is part of the form.
  const auto judge = [](Scene scene, const char* estimator) {
    scene.objects.clear();
    const Film exact = closed_form(scene);
    scene.render.estimator = estimator;
    scene.render.isa = InstructionSet::reference;
    scene.render.light_selection = LightSelection::unoccluded;
    scene.render.spp = 3;
    const Film film = render(scene).film;
    for (int y = 0; y < scene.resolution.height; ++y)
      for (int x = 0; x < scene.resolution.width; ++x)
        for (int k = 0; k < 3; ++k) {
          const double truth = exact.radiance(x, y)[k];
          // Films keep floats.
          EXPECT_NEAR(film.radiance(x, y)[k], truth, 1e-6 * truth) << estimator;
        }
  };
  Scene same_colour = four_lights(false);
  double strength = 1;
  for (Lights& light : same_colour.lights)
    std::visit([&](auto& l) { l.irradiance = Rgb<double>(3, 2, 1) * (strength *= 1.7); }, light);
  for (const char* estimator : {"mcwvds", "rewv", "whole_volume+difference"})
    judge(same_colour, estimator);
  for (const char* estimator : {"rewv", "rees", "reds"}) judge(four_lights(true), estimator);
  judge(four_lights(true), "whole_volume+difference");
}

TEST(LightSelection, by_the_closed_form_beats_the_blind) {
  for (const bool rgb : {false, true}) {
    Scene scene = four_lights(rgb);
    const Image exact = closed_form(scene).layer("beauty");
    Renderer renderer(scene);
    const auto error = [&](LightSelection selection) {
      RenderSettings settings = scene.render;
      settings.estimator = "mcwvds";
      settings.light_selection = selection;
      settings.spp = 1;  // as many as there are lights, stratified, would ask each of them once
      double sum = 0;
      for (int seed = 0; seed < 8; ++seed) {
        settings.seed = seed;
        sum += compare(renderer.render(settings).film.layer("beauty"), exact).mse;
      }
      return sum / 8;
    };
    const double by_closed_form = error(LightSelection::unoccluded);
    EXPECT_LT(2 * by_closed_form, error(LightSelection::uniform));
    std::printf("[ measured ] mean square error, uniform over unoccluded: %.2f\n",
                error(LightSelection::uniform) / by_closed_form);
  }
}

TEST(LightSelection, serves_discs_narrow_and_wide) {
  for (const double diameter : {0.5, 8.}) {
    Scene scene = four_lights(true);
    scene.render.samples_per_ray = 1;
    for (Lights& light : scene.lights)
      if (auto* sun = std::get_if<Directional>(&light)) sun->angular_diameter = diameter;
    Renderer renderer(scene);
    const auto means = [&](LightSelection selection) {
      RenderSettings settings = scene.render;
      settings.estimator = "mcwvds";
      settings.light_selection = selection;
      settings.spp = 64;
      std::vector<double> values;
      for (int seed = 0; seed < 24; ++seed) {
        settings.seed = seed + (selection == LightSelection::all ? 100 : 0);
        values.push_back(mean_over_picture(renderer.render(settings).film).plain.g);
      }
      return values;
    };
    const std::vector<double> all = means(LightSelection::all);
    for (const LightSelection selection : picking) {
      const std::vector<double> picked = means(selection);
      const double error = std::hypot(standard_error(all), standard_error(picked));
      EXPECT_LT(error, 3e-3 * mean(all));
      EXPECT_LT(std::abs(mean(picked) - mean(all)), 4 * error) << name_of(selection);
    }
  }
}

TEST(LightSelection, is_told_by_a_probe_light_by_light) {
  Scene scene = four_lights(false);
  scene.render.estimator = "mcwvds";
  scene.render.light_selection = LightSelection::unoccluded;
  scene.render.spp = 16;
  const Probe found = probe(scene, scene.render, 4, 11);
  Rgb<double> sum;
  std::size_t samples = 0;
  for (const ProbedLight& light : found.rays.at(0).lights) {
    sum += light.mean.plain;
    samples += light.samples.size();
  }
  EXPECT_EQ(samples, 16u);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], found.in_scatter[k], 1e-6 * sum[k]);
}

TEST(LightSelection, is_refused_where_there_are_no_samples) {
  Scene scene = four_lights(false);
  scene.render.estimator = "closed_form";
  scene.render.light_selection = LightSelection::uniform;
  try {
    render(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "estimator closed_form has no samples that could ask one light each: accepted "
                 "with it is light_selection = \"all\"");
  }
}

TEST(LightSelection, leaves_paths_what_they_are) {
  struct Way {
    const char* estimator;
    Continuation continuation;
    bool rgb, joined;
  };
  double worst = 0;
  for (const Way& way :
       {Way{"rewv", Continuation::distance, false, false},
        Way{"reds", Continuation::distance, true, true},
        Way{"rewv", Continuation::mix, true, false}, Way{"reds", Continuation::sample, false, true},
        Way{"rewv", Continuation::whole_volume, false, false}}) {
    Scene scene = four_lights(way.rgb);
    scene.resolution = {8, 8};
    scene.objects[0].material.albedo = Rgb<double>(0.7);
    scene.render.estimator = way.estimator;
    scene.render.continuation = way.continuation;
    scene.render.max_depth = 4;
    scene.render.spp = 64;
    if (way.joined) {
      Medium left = scene.media[0], right = left;
      left.shape = Box{{-1, -1, -1}, {0.2, 1, 1}};
      right.shape = Box{{0.2, -1, -1}, {1, 1, 1}};
      scene.media = {left, right};
    }
    Renderer renderer(scene);
    const auto sums = [&](LightSelection selection) {
      RenderSettings settings = scene.render;
      settings.light_selection = selection;
      std::array<std::array<std::vector<double>, 3>, 3> values;
      for (int seed = 0; seed < 24; ++seed) {
        settings.seed = seed + (selection == LightSelection::all ? 100 : 0);
        const Rendered rendered = renderer.render(settings);
        EXPECT_EQ(rendered.rejected, 0);
        const Estimate<double> e = mean_over_picture(rendered.film);
        const Rgb<double> found[3] = {e.plain + e.occluded, e.plain + e.analytic,
                                      e.plain + e.unoccluded};
        for (int s = 0; s < 3; ++s)
          for (int k = 0; k < 3; ++k) values[s][k].push_back(found[s][k]);
      }
      return values;
    };
    const auto all = sums(LightSelection::all);
    for (const LightSelection selection : picking) {
      const auto picked = sums(selection);
      for (int s = 0; s < 3; ++s)
        for (int k = 0; k < 3; ++k) {
          const double error = std::hypot(standard_error(all[s][k]), standard_error(picked[s][k]));
          const double z = (mean(picked[s][k]) - mean(all[s][k])) / error;
          EXPECT_LT(std::abs(z), 4) << way.estimator << " " << int(way.continuation) << " "
                                    << name_of(selection) << ", sum " << s << ", channel " << k;
          EXPECT_LT(error, 0.02 * mean(all[s][k])) << way.estimator << " proves little";
          worst = std::max(worst, std::abs(z));
        }
    }
  }
  std::printf("[ measured ] worst z of a sum of paths: %.2f\n", worst);
}

TEST(LightSelection, by_the_closed_form_beats_the_blind_on_paths) {
  Scene scene = four_lights(true);
  scene.render.estimator = "mcwvds";
  scene.render.max_depth = 4;
  scene.render.spp = 16;
  Renderer renderer(scene);
  const auto variance = [&](LightSelection selection) {
    scene.render.light_selection = selection;
    std::vector<double> values;
    for (int seed = 0; seed < 24; ++seed) {
      scene.render.seed = seed;
      values.push_back(mean_over_picture(renderer.render(scene.render).film).plain.g);
    }
    return standard_error(values) * standard_error(values);
  };
  const double by_closed_form = variance(LightSelection::unoccluded);
  const double blind = variance(LightSelection::uniform);
  EXPECT_LT(2 * by_closed_form, blind);
  std::printf("[ measured ] variance of paths, uniform over unoccluded: %.2f\n",
              blind / by_closed_form);
}

}  // namespace
}  // namespace airlight
