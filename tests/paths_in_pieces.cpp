// Light that scatters again and again in media side by side and inside meshes: order by order
// against a plain walk of photons that knows of no boundary, against one convex medium cut up or
// given as triangles, and against what the conservation of energy demands.
#include <airlight/free_flight.h>
#include <airlight/media.h>
#include <gtest/gtest.h>

#include "render/kernel.h"
#include "render/render.h"
#include "report/statistics.h"
#include "scene/closed_mesh.h"
#include "support/meshes.h"
#include "support/plain_walks.h"
#include "support/stats.h"

namespace airlight {
namespace {

using test::AnalogWalk;
using test::Colour;
using test::Sheet;
using test::Vector;

constexpr int orders = 4;

// --- scenes -------------------------------------------------------------------------------------

/// A box of fog in colours.
struct Part {
  Vector min, max;
  Colour sigma_t, albedo;
  double g;

  Medium medium() const {
    Medium result;
    result.sigma_t = sigma_t, result.sigma_s = sigma_t * albedo;
    result.phase = HenyeyGreenstein{g};
    result.shape = Box{min, max};
    return result;
  }
};

/// An L seen from above: light leaves one wing, crosses the courtyard and enters the other.
constexpr Colour dust{0.4, 1.2, 2.5}, dust_albedo{0.95, 0.8, 0.9};
const std::vector<Part> wings = {{{-1, -1, -1}, {1, 1, 0}, dust, dust_albedo, 0.5},
                                 {{-1, -1, 0}, {0, 1, 1}, dust, dust_albedo, 0.5}};

const std::vector<Part> fogs = {
    {{-1, -1, -1}, {0, 1, 1}, {0.3, 1, 3}, {0.95, 0.8, 0.9}, 0.6},
    {{0, -1, -1}, {1, 0.7, 1}, {2.5, 0.7, 0.4}, {0.9, 0.95, 0.6}, -0.4},
    {{-0.8, 1.2, -1}, {1, 1.6, 0.8}, {0.8, 0.5, 0.3}, {0.3, 0.9, 0.9}, 0}};

std::vector<Medium> joined(const std::vector<Part>& parts) {
  std::vector<Medium> media;
  for (const Part& part : parts) media.push_back(part.medium());
  return media;
}

std::vector<Medium> inside(const test::TestMesh& mesh, const Part& of) {
  Medium medium = of.medium();
  medium.shape = Solid{close_mesh(mesh.points, mesh.triangles)};
  return {medium};
}

test::TestMesh l_mesh() {
  return test::prism({{-1, -1}, {-1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, -1}}, {-0.5, -0.5}, -1, 1);
}

/// A floor below the media, a ball between them, a sun that shines through all of them.
Scene scene_of(std::vector<Medium> media) {
  Scene scene;
  scene.resolution = {3, 1};
  scene.camera = {
      .position = {2.5, 0.6, 2.2}, .target = {-0.2, -0.1, 0.1}, .up = {0, 1, 0}, .fov = 12};
  scene.media = std::move(media);
  Directional sun;
  sun.direction = -normalize(Vector(0.8, 0.7, -0.6));
  sun.irradiance = Colour(3., 2., 1.);
  scene.lights = {sun};
  scene.objects = {test::floor_of_the_walks(), test::ball_of_the_walks()};
  scene.render.samples_per_ray = 0;
  scene.render.visibility = Visibility::analytic;
  return scene;
}

// --- orders -------------------------------------------------------------------------------------

using Measured = test::ByOrder<orders>;

Measured walked(const std::vector<Part>& parts, const Scene& scene) {
  Measured truth;
  for (int c = 0; c < 3; ++c) {
    AnalogWalk walk;
    walk.fogs.clear();
    for (const Part& p : parts) walk.fogs.push_back({p.sigma_t[c], p.albedo[c], p.g, p.min, p.max});
    walk.floor_albedo = test::floor_colour[c], walk.ball_albedo = test::ball_grey;
    test::walk_through(scene, walk, c, unsigned(11 + c), truth);
  }
  return truth;
}

/// Light with shadows, and what the closed form and the samples say without them.
struct Sums {
  Colour lit, analytic, unoccluded;
};

/// The mean over a picture.
Sums sums_of(const Film& film) {
  Sums sums;
  const double n = double(film.pixel_count());
  for (std::size_t i = 0; i < film.pixel_count(); ++i) {
    const PixelSums pixel = film.pixel(i);
    const Estimate<double> e = mean_estimate(pixel);
    const Colour plain = e.plain + pixel.surface * (1 / pixel.sample_count());
    sums.lit += (plain + e.occluded) * (1 / n);
    sums.analytic += (plain + e.analytic) * (1 / n);
    sums.unoccluded += (plain + e.unoccluded) * (1 / n);
  }
  return sums;
}

/// The sums of each order with independent seeds. A path goes the same way however long it may
/// become: what one event more adds is the light of that order.
std::array<Measured, 3> orders_of(const Scene& scene, RenderSettings settings, int seeds) {
  Renderer renderer(scene);
  std::vector<Sums> values[orders];
  for (int seed = 0; seed < seeds; ++seed) {
    settings.seed = 100 + seed;
    Sums before;
    for (int k = 0; k < orders; ++k) {
      settings.max_depth = k + 1;
      const Rendered rendered = renderer.render(settings);
      EXPECT_EQ(rendered.rejected, 0);
      const Sums all = sums_of(rendered.film);
      values[k].push_back({all.lit - before.lit, all.analytic - before.analytic,
                           all.unoccluded - before.unoccluded});
      before = all;
    }
  }
  std::array<Measured, 3> result;
  const auto measure = [&](Measured& to, Colour Sums::*which) {
    for (int k = 0; k < orders; ++k)
      for (int c = 0; c < 3; ++c) {
        std::vector<double> one;
        for (const Sums& sums : values[k]) one.push_back((sums.*which)[c]);
        to.mean[k][c] = mean(one), to.error[k][c] = standard_error(one);
      }
  };
  measure(result[0], &Sums::lit);
  measure(result[1], &Sums::analytic);
  measure(result[2], &Sums::unoccluded);
  return result;
}

struct Place {
  const char* name;
  std::vector<Part> parts;
  bool mesh;

  Scene scene() const { return scene_of(mesh ? inside(l_mesh(), parts[0]) : joined(parts)); }
  friend void PrintTo(const Place& place, std::ostream* out) { *out << place.name; }
};

class EveryPlace : public testing::TestWithParam<Place> {};

TEST_P(EveryPlace, gives_every_order_alike_however_it_is_sampled) {
  const Scene scene = GetParam().scene();
  const Measured truth = walked(GetParam().parts, scene);
  struct Way {
    const char* estimator;
    Continuation continuation;
    SurfaceSums surface;
    InstructionSet isa = InstructionSet::best;
  };
  constexpr SurfaceSums split = SurfaceSums::split;
  double worst = 0, noise = 0;
  for (const Way& way :
       {Way{"rees", Continuation::distance, split},
        Way{"reds", Continuation::distance, SurfaceSums::ratio},
        Way{"rewv", Continuation::distance, split},
        Way{"rewv", Continuation::distance, split, InstructionSet::reference},
        Way{"mix+ratio", Continuation::distance, split},
        Way{"rewv", Continuation::mix, SurfaceSums::ratio},
        Way{"rewv", Continuation::whole_volume, split}, Way{"reds", Continuation::sample, split}}) {
    RenderSettings settings = scene.render;
    settings.estimator = way.estimator, settings.continuation = way.continuation;
    settings.surface = way.surface, settings.isa = way.isa;
    // Few samples and many seeds: the error of many strata is where a jump falls in one of them,
    // far from normal in the mean of a few seeds.
    settings.spp = 64;
    const auto [lit, analytic, unoccluded] =
        orders_of(scene, settings, way.isa == InstructionSet::reference ? 96 : 384);
    SCOPED_TRACE(testing::Message() << way.estimator << " " << int(way.continuation));
    worst = std::max({worst, expect_alike(lit, truth), expect_alike(unoccluded, analytic)});
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(lit.error[1][c] / lit.mean[1][c], 0.06) << "proves little";
    noise = std::max(noise, lit.error[3][1] / lit.mean[3][1]);
  }
  std::printf("[ measured ] worst z %.2f; largest relative standard error of order 4 %.4f\n", worst,
              noise);
}

INSTANTIATE_TEST_SUITE_P(PathsInPieces, EveryPlace,
                         testing::Values(Place{"an L of two boxes", wings, false},
                                         Place{"fogs side by side", fogs, false},
                                         Place{"an L inside a mesh", wings, true}));

TEST(Paths, see_every_fog_glow) {
  std::vector<Part> dark = fogs;
  for (Part& part : dark) part.albedo = Colour(0.);
  Scene scene = scene_of(joined(dark));
  scene.media[1].emission = Colour(0.2, 0.3, 0.4);
  scene.lights.clear();
  for (Object& object : scene.objects) object.material.albedo = Colour(0.);
  const Colour once = sums_of(render(scene).film).lit;
  scene.render.max_depth = 8;
  const Colour often = sums_of(render(scene).film).lit;
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(once[c], 0.01);
    EXPECT_NEAR(often[c], once[c], 1e-5 * once[c]);
  }
}

// --- the same medium said otherwise
// ---------------------------------------------------------------

const Part whole = {{-1, -1, -1}, {1, 1, 1}, {0.3, 1, 3}, {0.95, 0.8, 0.9}, 0.6};

/// The means of a picture over seeds, of light that scatters up to 8 times behind a tinted pane.
std::array<std::vector<double>, 3> pictures_of(std::vector<Medium> media) {
  Scene scene = scene_of(std::move(media));
  scene.resolution = {8, 8};
  scene.camera.fov = 40;
  scene.background = Colour(0.3, 0.2, 0.1);
  scene.media[0].emission = Colour(0.05);
  if (scene.media.size() > 1) scene.media[1].emission = Colour(0.05);
  Material glass;
  glass.opacity = 0.4;
  const Sheet pane{.corner = {-0.3, -0.7, 0.9},
                   .right = {1.2, 0, -0.5},
                   .up = {0, 1.5, 0},
                   .albedo = {0.3, 0.5, 0.7},
                   .tint = {0.9, 0.6, 0.8}};
  scene.objects.push_back(pane.object("pane", glass));
  scene.render.spp = 256;
  scene.render.max_depth = 8;
  Renderer renderer(scene);
  std::array<std::vector<double>, 3> values;
  for (int seed = 0; seed < 16; ++seed) {
    scene.render.seed = seed;
    const Rendered rendered = renderer.render(scene.render);
    EXPECT_EQ(rendered.rejected, 0);
    const Colour lit = sums_of(rendered.film).lit;
    for (int c = 0; c < 3; ++c) values[std::size_t(c)].push_back(lit[c]);
  }
  return values;
}

void expect_same_mean(std::vector<Medium> media) {
  const auto found = pictures_of(std::move(media)), expected = pictures_of({whole.medium()});
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::hypot(standard_error(found[c]), standard_error(expected[c]));
    EXPECT_LT(std::abs(mean(found[c]) - mean(expected[c])) / error, 4) << c;
    EXPECT_LT(error, 0.004 * mean(expected[c])) << "proves little";
  }
}

TEST(Paths, in_a_box_cut_in_two_are_those_in_the_box) {
  Part left = whole, right = whole;
  left.max.x = right.min.x = 0.2;
  expect_same_mean(joined({left, right}));
}

TEST(Paths, in_a_cube_of_triangles_are_those_in_the_box) {
  expect_same_mean(inside(test::box_mesh(whole.min, whole.max), whole));
}

// --- energy -------------------------------------------------------------------------------------

// Nothing absorbs, so what arrives from anywhere is what the sky sends: 1 in every pixel.
TEST(WhiteFurnace, of_fogs_side_by_side_or_in_a_mesh_cannot_be_seen) {
  std::vector<Part> white = fogs;
  for (Part& part : white) part.albedo = Colour(1.);
  for (const auto& media : {joined(white), inside(l_mesh(), white[0])}) {
    Scene scene = scene_of(media);
    scene.resolution = {8, 8};
    scene.camera.fov = 40;
    scene.lights.clear();
    scene.background = Colour(1.);
    for (Object& object : scene.objects) object.material.albedo = Colour(1.);
    scene.render.max_depth = 1000;
    scene.render.spp = 128;
    Renderer renderer(scene);
    std::vector<double> values;
    for (int seed = 0; seed < 16; ++seed) {
      scene.render.seed = seed;
      values.push_back(sums_of(renderer.render(scene.render).film).lit.g);
    }
    EXPECT_LT(std::abs(test::z_score(values, 1, 1e-6)), 4) << mean(values);
    EXPECT_LT(standard_error(values), 0.004);
  }
}

TEST(FreeFlight, through_fogs_of_any_colours_never_carries_more_than_it_had) {
  const std::vector<Medium> media = joined(fogs);
  const Joined space(media);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u;
  int scattered = 0, arrived = 0;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector from(2 * u(random) - 1, 2 * u(random) - 1, 2 * u(random) - 1);
    const Vector toward = uniform_cap(Vector(0, 1, 0), 2., {u(random), u(random)});
    const LocalRay<double> ray{space.point(from), toward};
    auto stretches = space.stretches(ray, media[0]);
    const double begin = stretches.hull().t_enter, length = stretches.hull().t_exit - begin;
    if (!(length > 0)) continue;
    const Colour throughput(u(random), u(random), u(random) * 0.01);
    const auto flight = free_flight<3>(stretches, begin, length, throughput);
    const double t = flight.draw(u(random));
    const Colour on = t < length ? flight.scattered(t) : flight.arrived();
    const auto weight = [](const Colour& c) { return c.r + c.g + c.b; };
    worst = std::max(worst, weight(on) / weight(throughput) / (t < length ? 0.95 : 1));
    EXPECT_GT(weight(on), 0);
    ++(t < length ? scattered : arrived);
  }
  EXPECT_GT(scattered, 3000);
  EXPECT_GT(arrived, 3000);
  EXPECT_LT(worst, 1 + 1e-12);
}

}  // namespace
}  // namespace airlight
