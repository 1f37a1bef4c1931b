#include "study/reproductions/000/sample_histogram.h"

#include <airlight/estimators.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "render/probe.h"
#include "report/statistics.h"
#include "report/svg.h"
#include "study/brute_force.h"

namespace airlight::paper_000 {
namespace {

constexpr int bins = 256;
constexpr double least_p = 1e-4;

/// One trapezoid in every second colour, so that neighbours are told apart.
void shade_trapezoids(Plot& plot, const std::vector<double>& nodes, double t_max) {
  for (int odd : {0, 1}) {
    Shade shade{.colour = odd ? 5 : 4};
    for (std::size_t i = 1; i < nodes.size(); ++i)
      if (int(i % 2) == odd) shade.intervals.push_back({nodes[i - 1] / t_max, nodes[i] / t_max});
    if (!shade.intervals.empty()) plot.marks.push_back(shade);
  }
}

std::vector<double> edges(double low, double high) {
  std::vector<double> at;
  for (int i = 0; i <= bins; ++i) at.push_back(low + (high - low) * i / bins);
  return at;
}

}  // namespace

void sample_along(const BoxRay& ray, Reproduced& out) {
  const Box box;
  const Box::Space space = box.space();
  const Vec3<double> d = normalize(ray.direction), w = normalize(ray.toward);
  const LocalRay<double> local{space.point(ray.origin), space.vector(d)};
  const double t_max = space.clip(local).t_exit;
  Section<double, 1, Box::Space> section(space, local, space.vector(w), t_max, {ray.sigma_t});
  section.trace_way_out();
  const auto placed = WholeVolume{}.on(section, Channels<double, 1>{1});

  std::vector<double> nodes = {0};
  for (int i = 0; i < section.way.segments; ++i)
    if (section.trapezoids[0].integral[i] > 0) nodes.push_back(section.way.t[i + 1]);

  const std::vector<Plane> faces = faces_of(box);
  const BruteForceRay exact{faces, ray.origin, d, w, t_max, ray.sigma_t};
  const double whole = exact.integral(0, t_max);
  std::vector<double> share;  // of each bin, by the density
  const std::vector<double> edge = edges(0, t_max);
  for (int i = 0; i < bins; ++i)
    share.push_back(exact.integral(edge[std::size_t(i)], edge[std::size_t(i) + 1]) / whole);

  constexpr int strata = 1 << 16, independent = 1 << 20;
  std::vector<double> stratified, free;
  std::mt19937_64 random(4);
  const auto uniform = [&] { return std::ldexp(double(random() >> 11), -53); };
  for (int i = 0; i < strata; ++i) stratified.push_back(placed.sample((i + uniform()) / strata));
  for (int i = 0; i < independent; ++i) free.push_back(placed.sample(uniform()));

  std::vector<double> expected;
  for (double s : share) expected.push_back(s * independent);
  const Histogram drawn = histogram(free, bins, 0, t_max);
  const double p = drawn.outside > 0 ? 0 : chi_squared(drawn.counts, expected).p;
  const Histogram jittered = histogram(stratified, bins, 0, t_max);
  double farthest = 0;
  for (std::size_t i = 0; i < bins; ++i)
    farthest = std::max(farthest, std::abs(jittered.counts[i] - share[i] * strata));

  const std::string name = ray.name;
  out.rows.push_back({name + ": trapezoids that get samples",
                      {},
                      double(nodes.size() - 1),
                      double(ray.trapezoids),
                      double(ray.trapezoids)});
  out.rows.push_back({name + ": p of 1048576 independent samples, chi-squared", {}, p, least_p, 1});
  out.rows.push_back(
      {name + ": largest error of a bin's count, 65536 stratified samples", {}, farthest, 0, 2});

  Plot density{.title = name, .y = {"share of the samples", Scale::linear, 0}};
  Plot way{.x = {"distance along the camera ray, t / t_S", Scale::linear, 0, 1},
           .y = {"way through p(t) [m]", Scale::linear, 0},
           .height = 200};
  density.x = {"", Scale::linear, 0, 1};
  shade_trapezoids(density, nodes, t_max);
  shade_trapezoids(way, nodes, t_max);
  Bars bars{.name = "samples, 256 bins", .edges = edges(0, 1), .heights = {}, .colour = 0};
  Line pdf{.name = "density by quadrature", .markers = false, .colour = 1};
  Line length{.markers = false, .colour = 6};
  for (std::size_t i = 0; i < bins; ++i) {
    bars.heights.push_back(jittered.counts[i] / strata);
    pdf.x.push_back((double(i) + 0.5) / bins);
    pdf.y.push_back(share[i]);
    length.x.push_back(pdf.x.back());
    length.y.push_back(exact.length_at(pdf.x.back() * t_max));
  }
  density.marks.push_back(bars);
  density.marks.push_back(pdf);
  way.marks.push_back(length);
  const Plot plots[] = {density, way};
  out.page.figure(
      {svg(plots),
       fmt::format("{}. 2^{{16}} stratified samples, their density, and below them the way from "
                   "the camera to p(t) and on to where light enters; trapezoids are tinted. "
                   "σ_{{t}} = {} /m, t_{{S}} = {:.3f} m.",
                   name, ray.sigma_t, t_max)});
}

Scene empty_box(Vec3<double> camera, double fov, Vec3<double> toward, double sigma_t) {
  Scene scene;
  scene.resolution = {128, 128};
  scene.camera.position = camera;
  scene.camera.fov = fov;
  Medium fog;
  fog.sigma_s = fog.sigma_t = Rgb<double>(sigma_t);
  scene.media = {fog};
  Directional sun;
  sun.direction = -normalize(toward);
  scene.lights = {sun};
  scene.render.estimator = "mcwvds";
  scene.render.visibility = Visibility::analytic;
  scene.render.samples_per_ray = 0;
  scene.render.spp = 4;
  return scene;
}

void sample_in_picture(const Scene& scene, Reproduced& out) {
  const std::vector<Plane> faces = faces_of(std::get<Box>(scene.media[0].shape));
  const auto [width, height] = scene.resolution;
  Image pieces(width, height);
  std::vector<double> below;
  std::vector<int> rays(4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const ProbedRay ray = probe(scene, scene.render, x, y).rays.at(0);
      if (ray.lights.empty()) continue;
      const ProbedLight& light = ray.lights[0];
      const std::size_t n = light.nodes.size() - 1;
      ++rays.at(n);
      for (int c = 0; c < 3; ++c) pieces.at(x, y, c) = int(n) == c + 1 ? 0.7f : 0.1f;
      const double enter = *ray.t_enter;
      const BruteForceRay exact{faces,
                                scene.camera.position + ray.direction * enter,
                                ray.direction,
                                light.toward,
                                ray.t_exit - enter,
                                scene.media[0].sigma_t.r};
      const double whole = exact.integral(0, exact.t_max);
      for (const ProbedSample& sample : light.samples)
        below.push_back(exact.integral(0, sample.t - enter) / whole);
    }

  const Histogram h = histogram(below, bins, 0, 1 + 1e-12);
  const std::vector<double> even(bins, double(below.size()) / bins);
  const double p = h.outside > 0 ? 0 : chi_squared(h.counts, even).p;
  out.rows.push_back({fmt::format("picture: p of {} samples, {} a pixel, chi-squared", below.size(),
                                  scene.render.spp),
                      {},
                      p,
                      least_p,
                      1});

  Plot plot{.title = "all pixels together",
            .x = {"part of its ray's distribution below a sample", Scale::linear, 0, 1},
            .y = {"samples in a bin", Scale::linear, 0}};
  plot.marks.push_back(Bars{.name = "samples", .edges = edges(0, 1), .heights = h.counts});
  plot.marks.push_back(Rule{even[0], "", true});
  out.page.figures(
      std::vector<Figure>{
          {svg(plot), "If samples follow the density, what lies below them is uniform."},
          out.picture("trapezoids", pieces,
                      fmt::format("Trapezoids of each pixel: red 1 ({} pixels), green 2 ({}), "
                                  "blue 3 ({}).",
                                  rays[1], rays[2], rays[3]))},
      2,
      "In a picture. Every pixel has a density of its own, so samples can't be counted by "
      "distance: each is replaced by the part of its own ray's distribution that lies below it, "
      "found by quadrature. (The four of a pixel are stratified, which makes the counts a little "
      "more even than chance would.)");
}

void show_checks(Reproduced& out) {
  out.page.checks(
      out.rows,
      "The paper shows the agreement and prints no numbers. All counts are of 256 bins. A p "
      "below 0.0001 would mean that the samples do not follow the density. The ends of a "
      "bin cut two strata at most, so no count of stratified samples can be off by "
      "more than 2.");
}

}  // namespace airlight::paper_000
