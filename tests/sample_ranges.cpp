// A picture is a sum over its samples: in whatever ranges, crops, threads and order they come, it
// is the same one. And its noise is what the standard error says, or less.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "render/kernel.h"
#include "render/render.h"
#include "support/brute_force.h"

namespace airlight {
namespace {

using test::Colour;
using test::Sheet;

/// A shelf and a pane of glass in RGB fog, a sun with a disc and a parallel light, a background:
/// something of everything. 37 x 21 pixels, no multiple of any block or tile.
Scene everything() {
  Scene scene;
  scene.resolution = {37, 21};
  scene.camera = {.position = {0.7, 0.9, 3.7}, .target = {0, -0.1, 0}, .up = {0, 1, 0}, .fov = 38};
  Medium medium;
  medium.sigma_s = {0.2, 0.4, 0.9}, medium.sigma_t = {0.3, 0.7, 1.6};
  medium.emission = {0.02, 0.01, 0.03};
  medium.phase = HenyeyGreenstein{0.5};
  scene.media = {medium};
  scene.background = {0.3, 0.2, 0.1};
  scene.ambient = {0.05, 0.06, 0.07};
  Directional sun{.irradiance = {3, 2.5, 2}, .direction = normalize(Vec3<double>(-0.4, -1, -0.3))};
  sun.angular_diameter = 0.53;
  Directional lamp{.irradiance = {.5, 1, 2}, .direction = normalize(Vec3<double>(0.8, -0.7, -0.4))};
  scene.lights = {sun, lamp};
  const Sheet floor{
      .corner = {-3, -0.8, -3}, .right = {0, 0, 4.5}, .up = {6, 0, 0}, .albedo = {.7, .6, .5}};
  const Sheet shelf{.corner = {0.1, 0.2, -0.5},
                    .right = {0.6, 0.1, 0},
                    .up = {0, 0, 0.7},
                    .albedo = {.9, .1, .4}};
  const Sheet glass{
      .corner = {-0.8, -0.3, 0.6}, .right = {0.7, 0, 0}, .up = {0, 0.7, 0}, .tint = {.3, .8, .5}};
  Material pane;
  pane.opacity = 0.25;
  scene.objects = {floor.object("floor"), shelf.object("shelf"), glass.object("glass", pane)};
  scene.render.spp = 64;
  scene.render.first_sample = 0;
  scene.render.threads = 1;
  return scene;
}

Film film_of(Renderer& renderer, const RenderSettings& settings,
             const std::optional<PixelRect>& crop = {}) {
  RenderControl control;
  control.crop = crop;
  Rendered rendered = renderer.render(settings, control);
  EXPECT_EQ(rendered.rejected, 0);
  EXPECT_TRUE(rendered.complete);
  return std::move(rendered.film);
}

bool same_bits(const PixelSums& a, const PixelSums& b) {
  static_assert(sizeof(PixelSums) == 55 * sizeof(double));  // numbers only, no gaps
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_bits(const Film& a, const Film& b) {
  return std::ranges::equal(a.pixels(), b.pixels(),
                            [](const PixelSums& p, const PixelSums& q) { return same_bits(p, q); });
}

/// The largest difference of any two numbers of two films, relative to the larger of the pixel's
/// number and a thousandth of the layer's mean.
double largest_difference(const Film& a, const Film& b) {
  double worst = 0;
  for (const char* name : {"beauty", "in_scatter", "surface", "transmittance", "albedo", "normal",
                           "depth", "object", "plain", "analytic", "occluded", "unoccluded"}) {
    const Image x = a.layer(name), y = b.layer(name);
    const int width = x.width * x.channels;
    double mean = 0;
    for (int j = 0; j < x.height; ++j)
      for (int i = 0; i < width; ++i) mean += std::abs(x.row(j)[i]) / (double(width) * x.height);
    for (int j = 0; j < x.height; ++j)
      for (int i = 0; i < width; ++i) {
        const double p = x.row(j)[i], q = y.row(j)[i];
        if (p == q) continue;
        const double size = std::max({std::abs(p), std::abs(q), 1e-3 * mean});
        worst = std::max(worst, std::abs(p - q) / size);
      }
  }
  return worst;
}

/// A film and its parts add up the same floats in another order.
constexpr double rounding = 3e-6;

class EveryArithmetic : public testing::TestWithParam<const Kernel*> {
 protected:
  Scene scene = everything();
  Renderer renderer{scene};
  RenderSettings settings = [this] {
    RenderSettings s = scene.render;
    s.isa = GetParam()->isa;
    return s;
  }();

  Film merged(const std::vector<std::int64_t>& cuts) {
    RenderSettings part = settings;
    std::optional<Film> sum;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      part.first_sample = cuts[i];
      part.spp = cuts[i + 1] - cuts[i];
      Film film = film_of(renderer, part);
      if (sum)
        sum->merge(film);
      else
        sum = std::move(film);
    }
    return *sum;
  }
};

TEST_P(EveryArithmetic, ranges_of_samples_merge_into_the_whole) {
  for (const char* estimator : {"rewv", "mcwvds", "reds", "equidistant+difference"})
    for (std::int64_t per_ray : {1, 4, 16, 0}) {
      settings.estimator = estimator;
      settings.samples_per_ray = per_ray;
      const Film whole = film_of(renderer, settings);
      EXPECT_LT(largest_difference(merged({0, 16, 32, 48, 64}), whole), rounding)
          << estimator << ", " << per_ray << " a ray";
      EXPECT_LT(largest_difference(merged({0, 1, 7, 21, 46, 64}), whole), rounding)
          << estimator << ", " << per_ray << " a ray, unaligned";
    }
}

TEST_P(EveryArithmetic, a_range_far_along_is_as_good_as_any) {
  settings.samples_per_ray = 4;
  settings.first_sample = 1 << 20;
  const Film far_along = film_of(renderer, settings);
  settings.first_sample = 0;
  const Film first = film_of(renderer, settings);
  Colour a, b;
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) a += far_along.radiance(x, y), b += first.radiance(x, y);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 5e-3);  // other noise, the same picture
  EXPECT_FALSE(same_bits(far_along, first));
}

TEST_P(EveryArithmetic, a_crop_is_the_same_pixels) {
  settings.spp = 8;
  const Film whole = film_of(renderer, settings);
  for (const PixelRect& rect : {PixelRect{0, 0, 37, 21}, PixelRect{5, 3, 17, 11},
                                PixelRect{36, 20, 1, 1}, PixelRect{1, 1, 35, 1}}) {
    const Film crop = film_of(renderer, settings, rect);
    int different = 0;
    for (int y = 0; y < rect.height; ++y)
      for (int x = 0; x < rect.width; ++x)
        different += !same_bits(crop.pixel(std::size_t(y * rect.width + x)),
                                whole.pixel(std::size_t((y + rect.y0) * 37 + x + rect.x0)));
    EXPECT_EQ(different, 0) << "of " << rect.width * rect.height << " at " << rect.x0 << ","
                            << rect.y0;
  }
}

TEST_P(EveryArithmetic, threads_and_history_change_no_bit) {
  settings.spp = 8;
  const Film once = film_of(renderer, settings);
  for (int threads : {1, 2, 3, 5}) {
    settings.threads = threads;
    EXPECT_TRUE(same_bits(film_of(renderer, settings), once)) << threads << " threads";
  }
  RenderSettings other = settings;  // other renders in between leave nothing behind
  other.estimator = "rm", other.seed = 9, other.samples_per_ray = 1;
  film_of(renderer, other);
  other.visibility = Visibility::analytic;
  film_of(renderer, other);
  EXPECT_TRUE(same_bits(film_of(renderer, settings), once)) << "after other renders";
  Renderer another(scene);
  EXPECT_TRUE(same_bits(film_of(another, settings), once)) << "by another renderer";
}

TEST_P(EveryArithmetic, another_seed_gives_other_noise) {
  settings.spp = 8;
  const Film once = film_of(renderer, settings);
  for (std::int64_t seed : {std::int64_t(1), std::int64_t(2), std::int64_t(4294967295)}) {
    settings.seed = seed;
    const Film again = film_of(renderer, settings);
    int same = 0, foggy = 0;  // other rays see the background only
    for (std::size_t i = 0; i < once.pixel_count(); ++i) {
      const bool fog = mean_estimate(once.pixel(i)).analytic.g > 0;
      foggy += fog;
      same += fog && same_bits(once.pixel(i), again.pixel(i));
    }
    EXPECT_GT(foggy, 300);
    EXPECT_EQ(same, 0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(, EveryArithmetic, testing::ValuesIn(available_kernels()),
                         [](const auto& info) { return std::string(info.param->name); });

/// The mean square of the standard error over the mean square error, of all pixels and seeds.
double claimed_over_true(const char* estimator, std::int64_t spp, std::int64_t per_ray,
                         double disc) {
  Scene scene = everything();
  std::get<Directional>(scene.lights[0]).angular_diameter = disc;
  scene.media[0].emission = {};
  Renderer renderer(scene);
  RenderSettings settings = scene.render;
  settings.estimator = estimator;
  settings.samples_per_ray = per_ray;
  settings.first_sample.reset();
  settings.spp = 4096;
  settings.seed = 1000;
  if (per_ray != 0) settings.samples_per_ray = 1;
  const Image truth = film_of(renderer, settings).layer("in_scatter");
  settings.samples_per_ray = per_ray;
  settings.spp = spp;
  double claimed = 0, error = 0;
  for (int seed = 0; seed < 24; ++seed) {
    settings.seed = seed;
    const Film film = film_of(renderer, settings);
    const Image value = film.layer("in_scatter"), deviation = film.layer("standard_error");
    for (int y = 0; y < 21; ++y)
      for (int i = 0; i < 3 * 37; ++i) {
        claimed += double(deviation.row(y)[i]) * deviation.row(y)[i];
        const double off = double(value.row(y)[i]) - truth.row(y)[i];
        error += off * off;
      }
  }
  return claimed / error;
}

// Of two halves, each as well stratified as a picture of half the samples. Where the mean square
// error v falls as N^-p, that of a half is 2^p v, and since the whole is better than two
// independent halves, their errors are opposed: what is claimed is (2^p - 1) v. That is right for
// independent samples (p = 1), 3 v for a shadow edge on one ray (p = 2), 7 v for what is smooth (p
// = 3).
// It must not be too little: 24 seeds of 777 pixels know the quotient to about 5 %.
TEST(StandardError, is_not_too_small_and_not_far_too_large) {
  for (const char* estimator : {"mcwvds", "rewv", "rm", "reds", "distance+difference"}) {
    const struct {
      std::int64_t spp, per_ray;
      double most, disc = 0.53;
    } cases[] = {{4, 0, 7}, {16, 0, 7}, {64, 0, 7, 10}, {16, 1, 12}, {64, 4, 12}};
    for (const auto& [spp, per_ray, most, disc] : cases) {
      const double quotient = claimed_over_true(estimator, spp, per_ray, disc);
      std::printf("%s, %d spp, %d a ray, a disc of %g: claimed over true square error %.2f\n",
                  estimator, int(spp), int(per_ray), disc, quotient);
      EXPECT_GT(quotient, 0.9) << estimator << ", " << spp << " spp, " << per_ray << " a ray";
      EXPECT_LT(quotient, most) << estimator << ", " << spp << " spp, " << per_ray << " a ray";
    }
  }
}

// A film keeps the whole in double and its second half in float.
TEST(StandardError, of_a_half_that_asked_nothing_is_no_quotient_of_rounding) {
  Film film({1, 1}, {0, 0, 1, 1});
  const FilmPixels pixel = film.at(0, 0);
  const auto add = [&](int number, float first, float second) {  // in estimators' order, by channel
    for (int c = 0; c < 3; ++c) {
      const int row = 3 * number + c;
      pixel.sums[(film.layout.in_scatter(0) + row) * film_block::pixels] += double(first + second);
      pixel.features[(film.layout.second_half(0) + row) * film_block::pixels] += second;
    }
  };
  constexpr int analytic = 1, occluded = 2, unoccluded = 3;
  constexpr int samples = 100;  // of each half
  for (int i = 0; i < samples; ++i) {
    add(analytic, 1, 1);
    add(occluded, 0, 0.1f);
    add(unoccluded, 0, 0.3f);
  }
  pixel.samples[0] = pixel.samples[film_block::pixels] = samples;
  const double lit = 1. / 3;  // by the second half; the first says 0
  EXPECT_NEAR(film.layer("standard_error").at(0, 0, 1), lit / 2, 1e-6);
}

}  // namespace
}  // namespace airlight
