// A probe must tell what the renderer does, not what it might do.

#include "render/probe.h"

#include <gmock/gmock.h>

#include "error.h"
#include "render/render.h"
#include "scene/load_scene.h"

namespace airlight {
namespace {

/// A glass ball before another in coloured, glowing fog under two suns, one with a disc.
constexpr const char* everything = R"(
ambient = 0.2
background = [0.1, 0.2, 0.3]
[camera]
position = [0, 0.2, 3.1]
target = [0, 0, 0]
[image]
width = 32
height = 24
[[media]]
albedo = 0.8
sigma_t = [0.3, 1, 3]
emission = 0.05
phase = {type = "henyey-greenstein", g = 0.3}
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[lights]]
type = "directional"
irradiance = 20
direction = [-1, -1, 0.2]
[[lights]]
type = "directional"
irradiance = [3, 4, 5]
direction = [1, -2, -0.3]
angular_diameter = 4
[[objects]]
type = "sphere"
radius = 0.4
opacity = 0.5
tint = [0.9, 0.5, 0.3]
[[objects]]
type = "sphere"
centre = [0, -0.3, -1.9]
radius = 1
)";

Scene scene_with(const std::vector<Override>& changes) {
  return parse_scene(everything, "scene", changes);
}

Rgb<double> rendered(const Scene& scene, int x, int y) {
  RenderSettings settings = scene.render;
  settings.isa = InstructionSet::reference;
  RenderControl control;
  control.crop = PixelRect{x, y, 1, 1};
  return Renderer(scene).render(settings, control).film.radiance(0, 0);
}

void expect_near(const Rgb<double>& a, const Rgb<double>& b, double relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], relative * std::abs(b[c]) + 1e-12);
}

TEST(Probe, has_the_radiance_of_the_renderers_pixel) {
  const std::vector<std::vector<Override>> variants = {
      {},
      {"render.estimator=mcds", "render.spp=64", "render.samples_per_ray=1"},
      {"render.estimator=rees", "render.samples_per_ray=0", "render.seed=5"},
      {"render.estimator=mix+difference", "render.spp=12", "render.samples_per_ray=8"},
      {"render.estimator=rm", "render.edges=per_step", "media.0.sigma_t=1"},
      {"render.first_sample=6", "render.spp=7"},
      {"render.estimator=closed_form", "objects.0.opacity=1", "lights.1.angular_diameter=0"},
      {"media.0.shape={type=\"convex\", points=[[-1,-1,-1],[1,-1,-1],[0,1,0],[0,-1,1]]}"},
  };
  for (const auto& changes : variants) {
    const Scene scene = scene_with(changes);
    for (const auto& [x, y] : {std::pair(16, 11), {20, 4}, {3, 20}, {0, 0}}) {
      const Probe found = probe(scene, scene.render, x, y);
      // The film keeps its sums in double: a few roundings of 1e-16.
      expect_near(found.radiance, rendered(scene, x, y), 1e-13);
    }
  }
}

TEST(Probe, shows_rays_and_lights_that_add_up_to_the_pixel) {
  const Scene scene = scene_with({});
  const Probe found = probe(scene, scene.render, 16, 11);
  ASSERT_EQ(found.rays.size(), 4u);
  Estimate<double> sum;
  Rgb<double> surface;
  for (const ProbedRay& ray : found.rays) {
    EXPECT_EQ(ray.sample_count, 4u);
    ASSERT_EQ(ray.lights.size(), 2u);
    for (const ProbedLight& light : ray.lights) {
      EXPECT_EQ(light.samples.size(), 4u);
      sum += light.mean * 0.25;
    }
    sum.plain += ray.emission * 0.25;
    surface += ray.surface * 0.25;
  }
  // Sums of four: roundings of 1e-16.
  expect_near(sum.plain, found.mean.plain, 1e-13);
  expect_near(sum.analytic, found.mean.analytic, 1e-13);
  expect_near(sum.occluded, found.mean.occluded, 1e-13);
  expect_near(sum.unoccluded, found.mean.unoccluded, 1e-13);
  expect_near(surface, found.surface, 1e-13);
}

TEST(Probe, knows_what_the_ray_meets) {
  const Scene scene = scene_with({});
  const ProbedRay ray = probe(scene, scene.render, 16, 14).rays[0];
  ASSERT_TRUE(ray.hit && ray.end && ray.t_enter);
  EXPECT_EQ(ray.object, 0u);
  EXPECT_LT(*ray.hit, *ray.end) << "the first ball lets light through, the second ends the ray";
  // The camera is 2.1 m before the face z = 1, the ball 0.6 m behind it.
  EXPECT_NEAR(*ray.t_enter * -ray.direction.z, 2.1, 1e-12);
  EXPECT_GT(*ray.hit, 2.7);
  EXPECT_LE(ray.t_exit, *ray.end);
  const ProbedRay miss = probe(scene, scene.render, 0, 0).rays[0];
  EXPECT_FALSE(miss.hit || miss.end);
}

TEST(Probe, steps_and_nodes_agree_with_the_closed_form) {
  const Scene scene = scene_with({});
  const ProbedRay ray = probe(scene, scene.render, 12, 9).rays[0];
  for (const ProbedLight& light : ray.lights) {
    ASSERT_GE(light.nodes.size(), 2u);
    const double from = light.nodes.front().t, to = light.nodes.back().t;
    const double width = (to - from) / double(light.steps.size());
    Rgb<double> integral;
    double density = 0;
    for (const ProbedStep& step : light.steps) {
      integral += step.transmittance * width;
      density += step.pdf * width;
    }
    // The midpoint rule errs by x² / 24 where a step has the optical depth x, and a little at
    // kinks.
    double x = 0;
    for (std::size_t i = 1; i < light.nodes.size(); ++i) {
      const ProbedNode &a = light.nodes[i - 1], &b = light.nodes[i];
      x = std::max(x, std::abs(b.optical_depth.b - a.optical_depth.b) / (b.t - a.t) * width);
    }
    EXPECT_LT(x, 0.15);
    expect_near(integral, light.transmittance_integral, x * x / 20);
    EXPECT_NEAR(density, 1, x * x / 20);
    for (const ProbedNode& node : light.nodes)
      expect_near(node.optical_depth, scene.media[0].sigma_t * node.length, 1e-15);
    for (const ProbedSample& sample : light.samples) {
      EXPECT_GE(sample.t, from);
      EXPECT_LE(sample.t, to);
      bool in_light = false;
      for (const auto& [begin, end] : light.lit) in_light |= sample.t >= begin && sample.t <= end;
      // The lit parts are known to a step, and the second sun has a disc.
      if (light.light == 0 && sample.visibility.r > 0 && !in_light) {
        double nearest = 1;
        for (const auto& [begin, end] : light.lit)
          nearest = std::min({nearest, std::abs(sample.t - begin), std::abs(sample.t - end)});
        EXPECT_LE(nearest, width);
      }
    }
  }
}

TEST(Probe, measures_the_way_through_media_in_pieces_from_the_camera_to_where_a_beam_starts) {
  // Two fogs of σ_t = 0.5 and 1 side by side; the beam starts in the first, half a metre above.
  const Scene scene = parse_scene(R"(
[camera]
position = [0.2, 0, 5]
target = [0.2, 0, 0]
[image]
width = 1
height = 1
[render]
samples_per_ray = 0
[[media]]
sigma_s = 0.5
sigma_a = 0
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
[[media]]
sigma_s = 1
sigma_a = 0
shape = {type = "box", min = [-1, -1, -3], max = [1, 1, -1]}
[[lights]]
type = "collimated"
irradiance = 1
position = [0, 0.5, -0.7]
direction = [0, -1, 0]
cross_section = {type = "rectangle", width = 2, height = 1.6}
)",
                                  "scene", {});
  const ProbedRay ray = probe(scene, scene.render, 0, 0).rays.at(0);
  const std::vector<ProbedNode>& nodes = ray.lights.at(0).nodes;
  ASSERT_FALSE(nodes.empty());
  // Into the fog at z = 1, t = 4, and into the beam at z = 0.1; into the second fog at z = -1,
  // where the depth of the way to the light jumps; out of the beam at z = -1.5.
  ASSERT_EQ(nodes.size(), 4u);
  const double t[] = {4.9, 6, 6, 6.5}, depth[] = {0.45 + 0.25, 1 + 0.25, 1 + 0.5, 1.5 + 0.5};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_NEAR(nodes[i].t, t[i], 1e-12);
    EXPECT_NEAR(nodes[i].length, t[i] - 4 + 0.5, 1e-12);
    EXPECT_NEAR(nodes[i].optical_depth.r, depth[i], 1e-12);
  }
}

TEST(Probe, refuses_a_pixel_outside_of_the_picture) {
  const Scene scene = scene_with({});
  for (const auto& [x, y] : {std::pair(-1, 0), {0, -1}, {32, 0}, {0, 24}})
    EXPECT_THROW(probe(scene, scene.render, x, y), Error);
}

TEST(Probe, refuses_more_samples_than_can_be_told) {
  Scene scene = scene_with({"render.spp=1048577"});
  EXPECT_THROW(probe(scene, scene.render, 0, 0), Error);
}

}  // namespace
}  // namespace airlight
