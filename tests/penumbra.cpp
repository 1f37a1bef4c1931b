// The sun's disc past the edge of an awning: pictures of soft shadows in fog and on a floor against
// quadrature over the disc (and along the ray), every placement with every form.
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

constexpr double narrow = 0.53, wide = 3;

/// Half a plane: of its edges only that at x = 0.25 counts.
const Sheet awning{.corner = {0.25, 4, -40}, .right = {40, 0, 0}, .up = {0, 0, 80}};
const Sheet ground{
    .corner = {-8, -0.5, -8}, .right = {0, 0, 16}, .up = {16, 0, 0}, .albedo = {.7, .6, .5}};

Scene scene_of(double diameter, const std::vector<Sheet>& sheets) {
  Scene scene;
  scene.resolution = {6, 6};
  scene.camera = {
      .position = {0.3, 0.5, 3.6}, .target = {0.05, -0.1, 0}, .up = {0, 1, 0}, .fov = 28};
  Medium medium;
  medium.sigma_s = Colour(0.8), medium.sigma_t = Colour(1.1);
  medium.phase = HenyeyGreenstein{0.4};
  scene.media = {medium};
  Directional sun;
  sun.irradiance = Colour(3.);
  sun.direction = -normalize(Vector(0.1, 1, -0.2));
  sun.angular_diameter = diameter;
  scene.lights = {sun};
  for (const Sheet& sheet : sheets) scene.objects.push_back(sheet.object("sheet"));
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  return scene;
}

/// Directions of a disc, uniform in solid angle: `height` in [0, 1] of the cap, turned.
struct Disc {
  Vector axis, across, other;
  double cap;

  Disc(const Vector& toward, double diameter) : axis(toward) {
    across = normalize(cross(axis, Vector(0.3, -0.5, 0.81)));
    other = cross(axis, across);
    const double s = std::sin(diameter * (std::acos(-1.) / 720));
    cap = 2 * s * s;
  }
  Vector operator()(double height, double turn) const {
    const double h = cap * height, s = std::sqrt(h * (2 - h));
    return axis * (1 - h) + across * (s * std::cos(turn)) + other * (s * std::sin(turn));
  }

  /// The mean over midpoints in height and in azimuth. Good where the integrand has no jumps.
  template <class Function>
  double mean(int rings, int spokes, Function&& f) const {
    double sum = 0;
    for (int i = 0; i < rings; ++i)
      for (int k = 0; k < spokes; ++k)
        sum += f((*this)((i + 0.5) / rings, 2 * std::acos(-1.) * (k + 0.5) / spokes));
    return sum / (rings * spokes);
  }

  /// The mean of what jumps at most once between the axis and the rim: where `side` changes.
  template <class Function, class Side>
  double mean_with_jump(Function&& f, Side&& side) const {
    const double turn = 2 * std::acos(-1.);
    return test::integrate(
               0, turn,
               [&](double phi) {
                 std::vector<double> jump;
                 double low = 0, high = 1;
                 if (side((*this)(low, phi)) != side((*this)(high, phi))) {
                   for (int i = 0; i < 50; ++i) {
                     const double middle = 0.5 * (low + high);
                     (side((*this)(middle, phi)) == side(axis) ? low : high) = middle;
                   }
                   jump.push_back(low);
                 }
                 return test::integrate(
                     0, 1, [&](double height) { return f((*this)(height, phi)); }, 1e-9, jump);
               },
               1e-6) /
           turn;
  }
};

struct Truth {
  double lit = 0, open = 0;
};

/// In-scatter of the whole picture, on average.
Truth mean_truth(const Scene& scene, const std::vector<Sheet>& sheets, int rings, int spokes) {
  const BruteForce truth(scene, sheets);
  const auto& sun = std::get<Directional>(scene.lights[0]);
  const Disc disc(-sun.direction, sun.angular_diameter);
  Truth mean;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) {
      const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
      mean.lit += disc.mean(
          rings, spokes, [&](const Vector& w) { return truth.in_scatter_grey(ray, sun, w, true); });
      mean.open += disc.mean(
          4, 8, [&](const Vector& w) { return truth.in_scatter_grey(ray, sun, w, false); });
    }
  return {mean.lit / 36, mean.open / 36};
}

class Penumbra : public testing::TestWithParam<double> {};

TEST_P(Penumbra, in_fog_is_the_mean_over_the_disc) {
  const Scene scene = scene_of(GetParam(), {awning});
  const Truth truth = mean_truth(scene, {awning}, 12, 32);
  // Kinks only, where the shadow's edge leaves a ray: the rule must have converged.
  const double rule = std::abs(mean_truth(scene, {awning}, 6, 16).lit / truth.lit - 1);
  EXPECT_LT(rule, 1e-4);
  EXPECT_GT(truth.lit, 0.2 * truth.open);
  EXPECT_LT(truth.lit, 0.8 * truth.open);
  double worst = 0, least_seen = 0;
  for (const Kernel* kernel : {available_kernels().front(), available_kernels().back()})
    for (const char* placement : {"equidistant", "distance", "whole_volume", "mix"})
      for (const char* form : {"monte_carlo", "ratio", "difference"}) {
        const std::string what = std::string(placement) + "+" + form + ", " + kernel->name;
        RenderSettings settings = scene.render;
        settings.estimator = std::string(placement) + "+" + form;
        settings.isa = kernel->isa;
        settings.spp = 64;
        constexpr int seeds = 240;
        Renderer renderer(scene);
        std::vector<double> plain, analytic, occluded, unoccluded;
        for (int seed = 0; seed < seeds; ++seed) {
          settings.seed = seed;
          const Rendered rendered = renderer.render(settings);
          ASSERT_EQ(rendered.rejected, 0);
          Estimate<double> mean;
          for (const auto& pixel : rendered.film.pixels()) mean += mean_estimate(pixel);
          plain.push_back(mean.plain.g / 36), analytic.push_back(mean.analytic.g / 36);
          occluded.push_back(mean.occluded.g / 36), unoccluded.push_back(mean.unoccluded.g / 36);
        }
        const auto judge = [&](const char* sum, const std::vector<double>& values, double want) {
          const double seen = test::relative_standard_error(values);
          EXPECT_LT(seen, 5e-4) << sum << " cannot be judged: " << what;
          // Rounding, and what is left of the quadrature's error when its steps are halved.
          const double slack = 4 * (seen + 3e-6) * want + rule / 3 * want;
          EXPECT_NEAR(mean(values), want, slack) << sum << ", " << what;
          worst = std::max(worst, std::abs(mean(values) - want) / (seen * want + 1e-6 * want));
          least_seen = std::max(least_seen, seen);
        };
        if (std::string(form) == "ratio") {
          judge("analytic", analytic, truth.open);
          judge("occluded", occluded, truth.lit);
          judge("unoccluded", unoccluded, truth.open);
        } else {
          judge("plain", plain, truth.lit);
        }
      }
  std::printf(
      "%g degrees: largest |z| %.2f, largest relative standard error %.1e, quadrature %.1e\n",
      GetParam(), worst, least_seen, rule);
}

TEST_P(Penumbra, on_a_floor_in_fog_is_the_mean_over_the_disc) {
  const std::vector<Sheet> sheets = {awning, ground};
  Scene scene = scene_of(GetParam(), sheets);
  // The shadow's edge falls on x = 0.25 - 0.1 * 4.5; the picture is twice as wide as its penumbra.
  scene.camera.target = {-0.2, ground.corner.y, 0};
  scene.camera.fov = 2.2 * GetParam();
  const BruteForce truth(scene, sheets);
  const auto& sun = std::get<Directional>(scene.lights[0]);
  const Disc disc(-sun.direction, sun.angular_diameter);
  for (const Kernel* kernel : {available_kernels().front(), available_kernels().back()}) {
    RenderSettings settings = scene.render;
    settings.isa = kernel->isa;
    settings.spp = 1024;
    Renderer renderer(scene);
    std::vector<std::vector<double>> values(36);
    for (int seed = 0; seed < 24; ++seed) {
      settings.seed = seed;
      const Film film = renderer.render(settings).film;
      for (std::size_t i = 0; i < 36; ++i)
        values[i].push_back(film.pixel(i).surface.r / film.pixel(i).sample_count());
    }
    int soft = 0;
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 6; ++x) {
        const CameraRay ray = test::camera_ray(scene, x + 0.5, y + 0.5);
        const auto [t, sheet] = truth.first(ray);
        if (!sheet || sheet->corner.y > 0) continue;
        const Vector p = ray.origin + ray.direction * t;
        const auto shaded = [&](const Vector& w) {
          return p.x + w.x / w.y * (awning.corner.y - p.y) > awning.corner.x;
        };
        const double light = disc.mean_with_jump(
            [&](const Vector& w) { return truth.irradiance(*sheet, p, ray.direction, w).r; },
            shaded);
        const auto [enter, leave] = truth.clip(ray);
        const double seen = std::exp(-1.1 * std::max(std::min(t, leave) - enter, 0.));
        const double want = 0.7 * 3 * light * seen / std::acos(-1.);
        const std::vector<double>& got = values[std::size_t(6 * y + x)];
        const double open = 0.7 * 3 * seen / std::acos(-1.);
        soft += standard_error(got) > 1e-6 * open;
        // Shadow rays start 2e-5 (|x| + |y| + |z| + t) above the floor, which moves the shadow of a
        // sun that stands oblique; across the penumbra light changes by 4 / (pi width) a metre at
        // most.
        const double lift = 2e-5 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + t);
        const double width = (awning.corner.y - p.y) * GetParam() * std::acos(-1.) / 180;
        const double moved = lift * 0.1 * 4 / (std::acos(-1.) * width);
        EXPECT_NEAR(mean(got), want, 4 * standard_error(got) + (moved + 3e-6) * open)
            << x << "," << y << ", " << kernel->name;
        EXPECT_LT(standard_error(got), 2e-3 * open);
      }
    EXPECT_GT(soft, 12) << "pixels in the penumbra";
  }
}

INSTANTIATE_TEST_SUITE_P(, Penumbra, testing::Values(narrow, wide),
                         [](const auto& info) { return info.param == narrow ? "narrow" : "wide"; });

TEST(PenumbraOfAPoint, is_a_sharp_shadow) {
  Scene scene = scene_of(0, {awning, ground});
  Renderer renderer(scene);
  const Film parallel = renderer.render(scene.render).film;
  std::get<Directional>(scene.lights[0]).angular_diameter = 1e-7;
  const Film tiny = Renderer(scene).render(scene.render).film;
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_NEAR(tiny.radiance(x, y).g, parallel.radiance(x, y).g,
                  1e-5 * parallel.radiance(x, y).g)
          << x << "," << y;
}

TEST(PenumbraOfNothing, is_the_mean_cosine_of_the_disc_s_parts) {
  for (const double diameter : {7., 60.}) {
    Scene scene = scene_of(diameter, {ground});
    scene.media.clear();
    std::get<Directional>(scene.lights[0]).direction = {0, -1, 0};
    scene.render.spp = 4096;
    const Film film = Renderer(scene).render(scene.render).film;
    const double cosine = (1 + std::cos(diameter * std::acos(-1.) / 360)) / 2;
    EXPECT_NEAR(film.radiance(3, 5).r, 0.7 * 3 * cosine / std::acos(-1.), 1e-5) << diameter;
  }
}

}  // namespace
}  // namespace airlight
