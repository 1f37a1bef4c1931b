// Light that scatters again and again: every way to sample it, order by order, against a plain walk
// of photons (support/analog_walk.h), against the kernel of single scattering, and against what the
// conservation of energy demands.
#include <gtest/gtest.h>

#include <cstring>

#include "image/metrics.h"
#include "render/prepare.h"
#include "render/render.h"
#include "render/tile_kernel.h"
#include "support/plain_walks.h"
#include "support/stats.h"

namespace airlight {
namespace {

using test::AnalogWalk;
using test::Colour;
using test::Sheet;
using test::Vector;

constexpr int orders = AnalogWalk::orders;

// --- scenes -------------------------------------------------------------------------------------

/// The media in which the paths' maths was checked on paper, and one in colours.
struct Fog {
  const char* name;
  Colour sigma_t, albedo;
  double g;
  bool floor, ball;

  friend void PrintTo(const Fog& fog, std::ostream* out) { *out << fog.name; }
};

const Fog fogs[] = {
    {"thin", Colour(1.), Colour(0.9), 0, false, false},
    {"thin and forward, on a floor", Colour(1.), Colour(0.8), 0.6, true, true},
    {"dense and backward, with a ball", Colour(3.), Colour(0.95), -0.4, false, true},
    {"dense and forward", Colour(3.), Colour(0.9), 0.8, false, false},
    {"very dense, with a ball", Colour(8.), Colour(0.9), 0, false, true},
    {"coloured, on a floor", {0.3, 1, 3}, {0.95, 0.8, 0.9}, 0, true, true},
};

Scene scene_of(const Fog& fog) {
  Scene scene;
  scene.resolution = {3, 1};
  scene.camera = {.position = {0.3, 0.8, 3.5}, .target = {0.1, -0.2, 0}, .up = {0, 1, 0}, .fov = 9};
  Medium medium;
  medium.sigma_t = fog.sigma_t, medium.sigma_s = fog.sigma_t * fog.albedo;
  medium.phase = HenyeyGreenstein{fog.g};
  scene.media = {medium};
  Directional sun;
  sun.direction = -normalize(Vector(0.4, 1, 0.3));
  sun.irradiance = Colour(3., 2., 1.);
  scene.lights = {sun};
  if (fog.floor) scene.objects.push_back(test::floor_of_the_walks());
  if (fog.ball) scene.objects.push_back(test::ball_of_the_walks());
  scene.render.samples_per_ray = 0;
  scene.render.visibility = Visibility::analytic;
  scene.render.max_depth = orders;
  return scene;
}

// --- what paths do ------------------------------------------------------------------------------

/// Sums of light by its order, and the worst growth of what a path carries.
struct Listener {
  std::array<Estimate<double>, orders + 1> by_order;  ///< [1] has scattered once
  Colour albedo;                                      ///< of the medium
  double worst_scattering = 0;  ///< Σβ' over Σβ and the largest albedo of the medium
  double worst_surface = 0;     ///< Σβ' over Σβ, past a surface

  template <Real F>
  void begins(const Paths<F>&) const noexcept {}

  template <Real F>
  void gathers(const Paths<F>& paths, const Estimate<F>& light, Mask<F> where) noexcept {
    const std::uint32_t lit = bits<F>(where);
    for (int i = 0; i < lanes<F>; ++i) {
      if (!((lit >> i) & 1u)) continue;
      Estimate<double>& sum = by_order[std::size_t(lane(paths.events, i)) + 1];
      sum.plain += at(light.plain, i), sum.analytic += at(light.analytic, i);
      sum.occluded += at(light.occluded, i), sum.unoccluded += at(light.unoccluded, i);
    }
  }

  template <Real F>
  void goes_on(const Paths<F>& before, const Rgb<F>& throughput, Mask<F> scatters,
               Mask<F> surface) noexcept {
    const std::uint32_t in_medium = bits<F>(scatters), on_surface = bits<F>(surface);
    const double most = std::max({albedo.r, albedo.g, albedo.b});
    for (int i = 0; i < lanes<F>; ++i) {
      const Colour was = at(before.throughput, i), is = at(throughput, i);
      const double growth = (is.r + is.g + is.b) / (was.r + was.g + was.b);
      if ((in_medium >> i) & 1u) worst_scattering = std::max(worst_scattering, growth / most);
      if ((on_surface >> i) & 1u) worst_surface = std::max(worst_surface, growth);
    }
  }

 private:
  template <Real F>
  static Colour at(const Rgb<F>& c, int i) {
    return {lane(c.r, i), lane(c.g, i), lane(c.b, i)};
  }
};

/// Every path of a picture, in one tile.
template <Real F>
Listener listen(const Scene& scene, const World& world, const RenderSettings& settings) {
  const Prepared prepared = prepare(scene, world, settings);
  Listener listener;
  if (!scene.media.empty())
    for (int c = 0; c < 3; ++c)
      listener.albedo[c] = scene.media[0].sigma_s[c] / scene.media[0].sigma_t[c];
  const PixelRect whole{0, 0, scene.resolution.width, scene.resolution.height};
  Film film(scene.resolution, whole, prepared.frame.layout, light_group_names(scene));
  Tile tile{whole, prepared.samples, film};
  render_paths<F>(prepared.frame, tile, listener);
  EXPECT_EQ(tile.rejected, 0);
  const double samples = double(settings.spp) * whole.width * whole.height;
  for (Estimate<double>& sums : listener.by_order) sums = sums * (1 / samples);
  return listener;
}

using Measured = test::ByOrder<orders>;

/// The three accumulators and the surfaces' plain sums of paths with independent seeds.
struct Sums {
  Measured occluded, analytic, unoccluded;
  Listener last;
};

constexpr int seeds = 64;  ///< the error of fewer means is itself too uncertain for four of it

Sums sums_of(const Scene& scene, RenderSettings settings) {
  const World world(scene, settings.visibility);
  settings.spp = 512;
  std::vector<Listener> runs;
  double growth = 0, surface = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    settings.seed = 100 + seed;
    runs.push_back(listen<FloatBatch>(scene, world, settings));
    growth = std::max(growth, runs.back().worst_scattering);
    surface = std::max(surface, runs.back().worst_surface);
  }
  Sums sums;
  sums.last = runs.back();
  sums.last.worst_scattering = growth, sums.last.worst_surface = surface;
  const auto measure = [&](Measured& to, auto value) {
    for (int k = 0; k < orders; ++k)
      for (int c = 0; c < 3; ++c) {
        std::vector<double> values;
        for (const Listener& run : runs)
          values.push_back(value(run.by_order[std::size_t(k) + 1])[c]);
        to.mean[k][c] = mean(values), to.error[k][c] = standard_error(values);
      }
  };
  measure(sums.occluded, [](const auto& e) { return e.plain + e.occluded; });
  measure(sums.analytic, [](const auto& e) { return e.plain + e.analytic; });
  measure(sums.unoccluded, [](const auto& e) { return e.plain + e.unoccluded; });
  return sums;
}

/// What plain walks give for the same picture.
Measured truth_of(const Fog& fog, const Scene& scene) {
  const auto& sun = std::get<Directional>(scene.lights[0]);
  const bool grey = fog.sigma_t.r == fog.sigma_t.b && fog.albedo.r == fog.albedo.b && !fog.floor;
  Measured truth;
  for (int c = 0; c < 3; ++c) {
    if (grey && c > 0) {  // the light's colour is all that tells them apart
      for (int k = 0; k < orders; ++k) {
        const double part = sun.irradiance[c] / sun.irradiance.r;
        truth.mean[k][c] = truth.mean[k][0] * part, truth.error[k][c] = truth.error[k][0] * part;
      }
      continue;
    }
    AnalogWalk walk;
    walk.fogs = {{.sigma_t = fog.sigma_t[c], .albedo = fog.albedo[c], .g = fog.g}};
    if (fog.floor) walk.floor_albedo = test::floor_colour[c];
    if (fog.ball) walk.ball_albedo = test::ball_grey;
    test::walk_through(scene, walk, c, unsigned(7 + c), truth);
  }
  return truth;
}

class EveryFog : public testing::TestWithParam<Fog> {};

TEST_P(EveryFog, gives_every_order_alike_however_it_is_sampled) {
  Scene scene = scene_of(GetParam());
  const Measured truth = truth_of(GetParam(), scene);
  struct Way {
    const char* estimator;
    Continuation continuation;
  };
  std::vector<Way> ways = {{"rees", Continuation::distance}, {"reds", Continuation::distance},
                           {"rewv", Continuation::distance}, {"mix+ratio", Continuation::distance},
                           {"rewv", Continuation::mix},      {"reds", Continuation::sample}};
  // Its tail is so heavy in dense fog that no number of paths tells its standard error.
  if (GetParam().sigma_t.b <= 1) ways.push_back({"rewv", Continuation::whole_volume});
  for (const Way& way : ways) {
    RenderSettings settings = scene.render;
    settings.estimator = way.estimator, settings.continuation = way.continuation;
    for (const SurfaceSums surface : {SurfaceSums::split, SurfaceSums::ratio}) {
      settings.surface = surface;
      const Sums sums = sums_of(scene, settings);
      SCOPED_TRACE(testing::Message()
                   << way.estimator << " " << int(way.continuation) << " " << int(surface));
      expect_alike(sums.occluded, truth);
      expect_alike(sums.unoccluded, sums.analytic);
      for (int c = 0; c < 3; ++c)
        EXPECT_LT(sums.occluded.error[1][c] / sums.occluded.mean[1][c], 0.06) << "proves little";
      if (way.continuation == Continuation::distance) {
        EXPECT_LT(sums.last.worst_scattering, 1 + 2e-6);
      } else if (way.continuation == Continuation::mix) {
        EXPECT_LT(sums.last.worst_scattering, 2 + 1e-4);
      }
      EXPECT_LT(sums.last.worst_surface, 1 + 2e-6);
      if (!GetParam().floor && !GetParam().ball) break;  // nothing to split
    }
  }
}

TEST(MultipleScattering, converges_in_every_pixel) {
  // Sixteen times as many paths leave a quarter of the difference between two seeds.
  Scene scene = scene_of(fogs[0]);
  scene.resolution = {16, 16};
  scene.render.estimator = "rewv";
  const auto difference = [&](std::int64_t spp) {
    RenderSettings settings = scene.render;
    settings.spp = spp;
    settings.seed = 1;
    const Image one = Renderer(scene).render(settings).film.layer("beauty");
    settings.seed = 2;
    return compare(one, Renderer(scene).render(settings).film.layer("beauty")).rmse;
  };
  EXPECT_LT(difference(4096), 0.3 * difference(256));
}

INSTANTIATE_TEST_SUITE_P(MultipleScattering, EveryFog, testing::ValuesIn(fogs));

// --- whole pictures -----------------------------------------------------------------------------

Film film_of(Scene& scene) {
  const Rendered rendered = Renderer(scene).render(scene.render);
  EXPECT_EQ(rendered.rejected, 0);
  return rendered.film;
}

/// The mean radiance of a picture over seeds, and its standard error, in green.
std::vector<double> radiance_by_seed(Scene scene, int count) {
  std::vector<double> values;
  for (int seed = 0; seed < count; ++seed) {
    scene.render.seed = seed;
    const Film film = film_of(scene);
    double sum = 0;
    for (int y = 0; y < film.crop.height; ++y)
      for (int x = 0; x < film.crop.width; ++x) sum += film.radiance(x, y).g;
    values.push_back(sum / double(film.pixel_count()));
  }
  return values;
}

/// Not the same scene twice: a coloured medium with a floor and a ball, and light behind it.
Scene everything() {
  Scene scene = scene_of(fogs[5]);
  scene.resolution = {24, 20};
  scene.camera.fov = 40;
  scene.background = Colour(0.3, 0.2, 0.1);
  scene.ambient = Colour(0.1);
  scene.media[0].emission = Colour(0.05);
  scene.render.spp = 8;
  scene.render.samples_per_ray = 2;
  return scene;
}

TEST(Paths, of_one_event_are_single_scattering) {
  Scene scene = everything();
  scene.render.isa = InstructionSet::reference;
  scene.render.max_depth = 1;
  const World world(scene, scene.render.visibility);
  const Prepared prepared = prepare(scene, world, scene.render);
  FilmLayout layout = prepared.frame.layout;
  const PixelRect whole{0, 0, 16, 16};
  Film single({16, 16}, whole, layout, light_group_names(scene));
  Film paths = single;
  Tile tile{whole, prepared.samples, single}, tile_of_paths{whole, prepared.samples, paths};
  render_tile<double>(prepared.frame, tile);
  render_paths<double>(prepared.frame, tile_of_paths);
  for (std::size_t i = 0; i < single.pixel_count(); ++i) {
    const PixelSums a = single.pixel(i), b = paths.pixel(i);
    const auto same = [&](const Colour& x, const Colour& y) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[c], y[c], 1e-6 * std::abs(y[c]) + 1e-12);
    };
    same(a.in_scatter[0].analytic, b.in_scatter[0].analytic);
    same(a.in_scatter[1].analytic, b.in_scatter[1].analytic);  // paths draw points of their own
    same(a.in_scatter[1].plain, b.in_scatter[1].plain);
    same(a.surface, b.surface);
    same(a.transmittance, b.transmittance);
    same(a.albedo, b.albedo);
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_NEAR(a.depth, b.depth, 1e-6 * b.depth);
    EXPECT_EQ(a.object, b.object);
  }
}

TEST(Paths, behind_glass_are_single_scattering_on_average) {
  Scene scene = everything();
  scene.resolution = {6, 6};
  Material pane;
  pane.opacity = 0.4;
  const Sheet glass{.corner = {-1, -0.7, 0.7},
                    .right = {2, 0, 0},
                    .up = {0, 1.5, 0},
                    .albedo = {0.3, 0.5, 0.7},
                    .tint = {0.9, 0.6, 0.8}};
  scene.objects.push_back(glass.object("pane", pane));
  scene.render.isa = InstructionSet::reference;
  scene.render.estimator = "mcwvds";
  scene.render.max_depth = 1;
  scene.render.spp = 64;
  const World world(scene, scene.render.visibility);
  const PixelRect whole{0, 0, 6, 6};
  std::vector<double> difference, radiance;
  for (int seed = 0; seed < 24; ++seed) {
    scene.render.seed = seed;
    const Prepared prepared = prepare(scene, world, scene.render);
    Film single({6, 6}, whole, prepared.frame.layout, light_group_names(scene));
    Film paths = single;
    Tile tile{whole, prepared.samples, single}, tile_of_paths{whole, prepared.samples, paths};
    render_tile<double>(prepared.frame, tile);
    render_paths<double>(prepared.frame, tile_of_paths);
    double off = 0, all = 0;
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 6; ++x)
        off += paths.radiance(x, y).g - single.radiance(x, y).g, all += single.radiance(x, y).g;
    difference.push_back(off / 36), radiance.push_back(all / 36);
  }
  EXPECT_LT(std::abs(test::z_score(difference, 0, 1e-9)), 4);
  EXPECT_LT(standard_error(difference), 0.005 * mean(radiance));
}

TEST(Paths, give_the_same_picture_for_any_number_of_threads) {
  Scene scene = everything();
  scene.resolution = {40, 24};
  scene.render.threads = 1;
  const Film one = film_of(scene);
  for (const int threads : {2, 3}) {
    scene.render.threads = threads;
    const Film more = film_of(scene);
    for (std::size_t i = 0; i < one.pixel_count(); ++i) {
      const PixelSums a = one.pixel(i), b = more.pixel(i);
      EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << i;
    }
  }
}

TEST(Paths, of_ranges_of_samples_add_up_to_the_whole) {
  Scene scene = everything();
  scene.render.first_sample = 0;
  const Film whole = film_of(scene);
  scene.render.spp = 4;
  Film parts = film_of(scene);
  scene.render.first_sample = 4;
  parts.merge(film_of(scene));
  for (std::size_t i = 0; i < whole.pixel_count(); ++i) {
    const Colour a = mean_estimate(whole.pixel(i)).occluded,
                 b = mean_estimate(parts.pixel(i)).occluded;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-12);
    EXPECT_EQ(whole.pixel(i).depth, parts.pixel(i).depth);
  }
}

// What a holdout sends into the fog is in a photograph and not in the scene.
TEST(Paths, meet_a_holdout_as_a_black_object_through_which_the_background_is_seen) {
  Scene scene = everything();
  scene.objects[1].material.albedo = Colour(0.);  // the ball
  const Film black = film_of(scene);
  scene.objects[1].holdout = true;
  const Film holdout = film_of(scene);
  int seen = 0;
  for (std::size_t i = 0; i < black.pixel_count(); ++i) {
    const PixelSums a = holdout.pixel(i), b = black.pixel(i);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(mean_estimate(a).occluded[c], mean_estimate(b).occluded[c]);
      EXPECT_EQ(mean_estimate(a).analytic[c], mean_estimate(b).analytic[c]);
      seen += a.transmittance[c] > b.transmittance[c];
    }
  }
  EXPECT_GT(seen, 60);
}

TEST(Paths, in_the_forms_are_sums_of_the_ratio_s) {
  Scene scene = scene_of(fogs[0]);  // all of it in-scatter
  scene.render.spp = 64;
  const auto sums = [&](const char* estimator) {
    scene.render.estimator = estimator;
    return mean_estimate(film_of(scene).pixel(1));
  };
  const Estimate<double> ratio = sums("reds"), monte_carlo = sums("mcds"),
                         difference = sums("distance+difference");
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(monte_carlo.plain[c], ratio.occluded[c], 1e-5 * ratio.occluded[c]);
    EXPECT_NEAR(difference.plain[c], ratio.analytic[c] - ratio.unoccluded[c] + ratio.occluded[c],
                1e-5 * ratio.occluded[c]);
  }
}

// --- energy -------------------------------------------------------------------------------------

// A room whose walls absorb nothing, seen from inside, lit by ambient light of radiance 2 on each
// of them: a path that bounces k times off them carries 1, and where it ends it meets 2, whatever
// k.
TEST(WhiteFurnace, of_white_walls_and_ambient_light_is_exactly_as_bright_as_that) {
  Scene scene;
  scene.resolution = {8, 8};
  scene.camera = {.position = {0, 0, 1}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 90};
  Material white;
  white.albedo = Colour(1.);
  scene.objects = {{"room", Sphere{{0, 0, 0}, 3}, white}, {"ball", Sphere{{0, 0, -1}, 0.5}, white}};
  scene.ambient = Colour(2.);
  scene.render.visibility = Visibility::analytic;
  for (const int depth : {2, 3, 9}) {
    scene.render.max_depth = depth;
    for (const Kernel* kernel : available_kernels()) {
      scene.render.isa = kernel->isa;
      const Film film = film_of(scene);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          EXPECT_NEAR(film.radiance(x, y).g, 2, 1e-5) << kernel->name << " " << depth;
    }
  }
}

/// Fog that absorbs nothing, a white ball and a white half-opaque pane, before a sky of radiance 1.
Scene furnace(const Colour& sigma) {
  Scene scene = scene_of(fogs[0]);
  scene.resolution = {8, 8};
  scene.camera.fov = 40;
  scene.lights.clear();
  scene.background = Colour(1.);
  scene.media[0].sigma_s = scene.media[0].sigma_t = sigma;
  scene.media[0].phase = HenyeyGreenstein{0.5};
  Material white, pane;
  white.albedo = Colour(1.);
  pane.opacity = 0.5;
  const Sheet glass{
      .corner = {-1, -0.7, 0.7}, .right = {2, 0, 0}, .up = {0, 1.5, 0}, .albedo = Colour(1.)};
  scene.objects = {{"ball", Sphere{{0, 0, 0}, 0.5}, white}, glass.object("pane", pane)};
  scene.render.max_depth = 1000;
  scene.render.spp = 256;
  return scene;
}

// Nothing absorbs, so what arrives from anywhere is what the sky sends: 1 in every pixel.
TEST(WhiteFurnace, of_fog_before_a_white_sky_cannot_be_seen) {
  for (const Colour& sigma : {Colour(1.), Colour(0.3, 1, 3)}) {
    const auto values = radiance_by_seed(furnace(sigma), 16);
    EXPECT_LT(std::abs(test::z_score(values, 1, 1e-6)), 4) << mean(values);
    EXPECT_LT(standard_error(values), 0.002);
  }
}

TEST(Energy, is_lost_where_the_fog_absorbs_and_never_won) {
  Scene scene = furnace(Colour(1.));
  scene.media[0].sigma_s = Colour(0.9);
  const auto values = radiance_by_seed(scene, 8);
  EXPECT_LT(mean(values), 1 - 10 * standard_error(values));
  EXPECT_GT(mean(values), 0.5);
}

// --- what the camera sees first ------------------------------------------------------------------

TEST(Paths, tell_of_the_first_surface_what_single_scattering_tells) {
  Scene scene = furnace(Colour(1.));
  scene.objects = {{"ball", Sphere{{0, 0, 0}, 0.5}, {}}};
  scene.resolution = {16, 12};  // packets see the ball in part
  scene.render.spp = 4;
  scene.render.samples_per_ray = 0;
  const auto film = [&](int max_depth) {
    scene.render.max_depth = max_depth;
    return Renderer(scene).render(scene.render).film;
  };
  const Film once = film(1), often = film(3);
  for (const char* name : {"transmittance", "albedo", "normal", "depth", "object"}) {
    const Image expected = once.layer(name), seen = often.layer(name);
    EXPECT_GT(std::ranges::max(expected.pixels), 0) << name;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
      ASSERT_NEAR(seen.pixels[i], expected.pixels[i], 1e-6) << name << ' ' << i;
  }
}

// --- directions ---------------------------------------------------------------------------------

template <class Function>
void expect_mean_cosine(double expected, Function&& direction) {
  const Vec3<double> axis = normalize(Vec3<double>(0.3, -0.8, 0.4));
  const Sampler<double> sampler{pixel_hash(3, 5, 7)};
  std::vector<double> cosines;
  Vec3<double> sum;
  constexpr std::uint32_t n = 1u << 16;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3<double> d = direction(axis, sampler.two(i, 0));
    EXPECT_NEAR(dot(d, d), 1, 1e-12);
    cosines.push_back(dot(d, axis));
    sum = sum + (d - axis * cosines.back());
  }
  EXPECT_NEAR(mean(cosines), expected, 1e-4);  // stratified: 1e-3 would be a standard error else
  EXPECT_LT(length(sum) / n, 2e-3);            // turned alike to all sides
}

TEST(Directions, scatter_by_their_mean_cosine) {
  for (const double g : {-0.7, -0.4, 0., 0.6, 0.95})
    expect_mean_cosine(g, [&](Vec3<double> axis, Vec2<double> u) {
      return scattered_direction<double>(Phases(HenyeyGreenstein{g}), axis, u);
    });
  for (const Phases& phase : {Phases(Isotropic{}), Phases(Rayleigh{})})
    expect_mean_cosine(0, [&](Vec3<double> axis, Vec2<double> u) {
      return scattered_direction<double>(phase, axis, u);
    });
  expect_mean_cosine(2. / 3,
                     [](Vec3<double> axis, Vec2<double> u) { return cosine_hemisphere(axis, u); });
}

}  // namespace
}  // namespace airlight
