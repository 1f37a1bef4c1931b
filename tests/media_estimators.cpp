// Media side by side and inside meshes as estimators and pictures see them: every sum of every
// placement and form against quadrature, and a box cut in two or made of triangles against the box.

#include <airlight/in_scatter.h>
#include <gtest/gtest.h>

#include "render/kernel.h"
#include "render/render.h"
#include "scene/closed_mesh.h"
#include "support/meshes.h"
#include "support/stats.h"
#include "support/unions.h"

namespace airlight {
namespace {

using test::Union;

const Vec3<double> toward = normalize(Vec3<double>(0.6, 0.7, 0.35));

/// What is beyond this plane lies in the shadow.
const Vec3<double> shade_normal = normalize(Vec3<double>(0.8, 0.1, 0.3));
constexpr double shade_at = 0.15;

/// Three bodies of fog, two of which touch, with a ray through all of them.
Union three_bodies(bool grey) {
  Union all;
  const auto add = [&](Vec3<double> low, Vec3<double> high, Rgb<double> sigma_t, double albedo,
                       const Phases& phase) {
    Medium medium;
    medium.sigma_t = grey ? Rgb<double>(sigma_t.g) : sigma_t;
    medium.sigma_s = medium.sigma_t * albedo;
    medium.phase = phase;
    medium.shape = Box{low, high};
    all.parts.push_back({test::box_body(test::point(low), test::point(high)), medium});
  };
  add({-1, -1, -1}, {-0.2, 1, 1}, {0.3, 0.6, 1}, 0.9, Isotropic{});
  add({-0.2, -0.9, -1}, {0.4, 0.7, 1}, {1.6, 0.9, 0.5}, 0.7, HenyeyGreenstein{0.6});
  add({0.7, -0.8, -0.6}, {1.3, 0.5, 0.9}, {0.2, 1.3, 2.2}, 0.8, Rayleigh{});
  all.ray.o = {-2, -0.4, 0.3};
  all.ray.d = normalize(Vec3<double>(1, 0.11, -0.07));
  all.ray.w = toward;
  all.ray.t_max = 5;
  return all;
}

struct Truth {
  Rgb<double> lit, open;
};

Truth truth_of(const Union& all, const Rgb<double>& irradiance) {
  Truth truth;
  const double edge = (shade_at - dot(shade_normal, all.ray.o)) / dot(shade_normal, all.ray.d);
  for (int c = 0; c < 3; ++c) {
    truth.open[c] = irradiance[c] * all.integral(c, 0, 0, all.ray.t_max);
    truth.lit[c] = irradiance[c] * all.integral(c, 0, 0, edge);
  }
  return truth;
}

struct ShadedBeyond {
  template <class F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F>, F, int, Mask<F>) const noexcept {
    const F ahead = dot(Vec3<F>(shade_normal), from);
    return Rgb<F>(select(ahead < F(Scalar<F>(shade_at)), F(1), F(0)));
  }
};

std::vector<Sampled> every_estimator() {
  std::vector<Sampled> all;
  for (const Placements& place :
       std::initializer_list<Placements>{Equidistant{}, Distance{}, WholeVolume{}, Mixed{}})
    for (const Forms& form : std::initializer_list<Forms>{MonteCarlo{}, Ratio{}, Difference{}})
      all.push_back({place, form});
  all.push_back({Equidistant{}, MonteCarlo{}, true});  // intersects at every step
  return all;
}

/// Each sum of every estimator, from independent seeds, is on average what it stands for.
template <Real F>
void expect_unbiased(std::span<const Medium> media, const test::BoxRay& ray, const Truth& truth,
                     const Rgb<double>& irradiance, double rounding) {
  constexpr int seeds = 4096 / lanes<F> * lanes<F>;
  constexpr std::uint32_t samples = 64;
  Directional sun;
  sun.direction = -toward;
  sun.irradiance = irradiance;
  for (const Sampled& estimator : every_estimator()) {
    const Estimate<double> wanted = std::visit(
        [&](const auto& form) { return form(truth.open, truth.lit, truth.open); }, estimator.form);
    std::vector<double> sums[3][4];
    for (int seed = 0; seed < seeds; seed += lanes<F>) {
      std::uint32_t hashes[16];
      for (int i = 0; i < lanes<F>; ++i) hashes[i] = pixel_hash(7, std::uint32_t(seed + i), 0);
      const Sampler<F> sampler{load_bits<F>(hashes)};
      const CameraRay<F> camera{Vec3<F>(ray.o), Vec3<F>(ray.d), F(Scalar<F>(ray.t_max))};
      const Estimate<F> found =
          in_scatter(estimator, media, sun, camera, samples, sampler, ShadedBeyond{});
      for (int i = 0; i < lanes<F>; ++i)
        for (int c = 0; c < 3; ++c) {
          sums[c][0].push_back(double(lane(found.plain[c], i)));
          sums[c][1].push_back(double(lane(found.analytic[c], i)));
          sums[c][2].push_back(double(lane(found.occluded[c], i)));
          sums[c][3].push_back(double(lane(found.unoccluded[c], i)));
        }
    }
    const std::string what =
        std::visit([](const auto& p) { return std::string(p.name); }, estimator.placement) + "+" +
        std::visit([](const auto& f) { return std::string(f.name); }, estimator.form);
    for (int c = 0; c < 3; ++c) {
      const double truths[4] = {wanted.plain[c], wanted.analytic[c], wanted.occluded[c],
                                wanted.unoccluded[c]};
      for (int k = 0; k < 4; ++k) {
        const double scale = truth.open[c];
        EXPECT_LT(std::abs(test::z_score(sums[c][k], truths[k], rounding * scale)), 4)
            << what << ", sum " << k << ", channel " << c << ": " << mean(sums[c][k]) << " for "
            << truths[k];
        // The march also steps where nothing scatters; all others are below half of this.
        EXPECT_LT(standard_error(sums[c][k]), 1e-3 * scale) << what << ", sum " << k;
      }
    }
  }
}

TEST(JoinedMedia, are_estimated_without_bias) {
  for (const bool grey : {true, false}) {
    SCOPED_TRACE(grey ? "grey" : "RGB");
    const Rgb<double> irradiance = grey ? Rgb<double>(1.5) : Rgb<double>(3., 2., 1.);
    const Union all = three_bodies(grey);
    std::vector<Medium> media;
    for (const Union::Part& part : all.parts) media.push_back(part.medium);
    const Truth truth = truth_of(all, irradiance);
    expect_unbiased<double>(media, all.ray, truth, irradiance, 1e-12);
    expect_unbiased<FloatBatch>(media, all.ray, truth, irradiance, 2e-6);
  }
}

/// An L as a union of boxes is the judge of the L as a mesh.
TEST(SolidMedium, is_estimated_without_bias) {
  for (const bool grey : {true, false}) {
    SCOPED_TRACE(grey ? "grey" : "RGB");
    Medium medium;
    medium.sigma_t = grey ? Rgb<double>(0.9) : Rgb<double>(0.3, 1, 2.4);
    medium.sigma_s = medium.sigma_t * 0.8;
    medium.phase = HenyeyGreenstein{0.4};
    Union all;
    const auto add = [&](Vec3<double> low, Vec3<double> high) {
      all.parts.push_back({test::box_body(test::point(low), test::point(high)), medium});
    };
    add({-1, -0.5, -1}, {0, 0.5, 1});
    add({0, -0.5, -1}, {1, 0.5, 0});
    // In through one arm, out where the arms meet, and in again.
    all.ray = {{-0.6, 0.1, 2}, normalize(Vec3<double>(0.55, 0.02, -1)), toward, 6};
    const test::TestMesh mesh = test::l_mesh();
    medium.shape = Solid{close_mesh(mesh.points, mesh.triangles)};
    const Rgb<double> irradiance = grey ? Rgb<double>(1.5) : Rgb<double>(3., 2., 1.);
    const Truth truth = truth_of(all, irradiance);
    expect_unbiased<double>({&medium, 1}, all.ray, truth, irradiance, 1e-12);
    expect_unbiased<FloatBatch>({&medium, 1}, all.ray, truth, irradiance, 2e-6);
  }
}

/// The mean over the sun's disc of what parallel light gives, by a fine grid of directions.
TEST(JoinedMedia, know_the_disc_of_the_sun) {
  const Union all = three_bodies(false);
  std::vector<Medium> media;
  for (const Union::Part& part : all.parts) media.push_back(part.medium);
  for (const double diameter : {0.53, 6.}) {
    Directional sun;
    sun.direction = -toward;
    sun.angular_diameter = diameter;
    Rgb<double> truth;
    constexpr int rings = 6, spokes = 24;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < spokes; ++j) {
        Union one = all;
        one.ray.w = uniform_cap(toward, sun.cap_height(),
                                Vec2<double>{(i + 0.5) / rings, (j + 0.5) / spokes});
        truth += truth_of(one, Rgb<double>(1. / (rings * spokes))).lit;
      }
    const Sampled estimator{WholeVolume{}, MonteCarlo{}};
    std::vector<double> means[3];
    for (std::uint32_t seed = 0; seed < 4096; ++seed) {
      const Sampler<double> sampler{pixel_hash(3, seed, 1)};
      const CameraRay<double> camera{all.ray.o, all.ray.d, all.ray.t_max};
      const auto found = in_scatter(estimator, std::span<const Medium>(media), sun, camera, 16,
                                    sampler, ShadedBeyond{});
      for (int c = 0; c < 3; ++c) means[c].push_back(found.plain[c]);
    }
    // The grid is off by a hundred-thousandth of what the disc changes.
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(std::abs(test::z_score(means[c], truth[c], 1e-5 * truth[c])), 4)
          << diameter << " degrees, channel " << c << ": " << mean(means[c]) << " for " << truth[c];
  }
}

// --- pictures ------------------------------------------------------------------------------------

/// A ball and a sheet of tinted glass in and beside a box of glowing fog, before a background.
Scene box_scene(const Vec3<double>& eye) {
  Scene scene;
  scene.resolution = {24, 16};
  scene.camera = {.position = eye, .target = {0, -0.1, 0}, .up = {0, 1, 0}, .fov = 44};
  Medium medium;
  medium.sigma_t = {0.3, 1, 2};
  medium.sigma_s = {0.2, 0.8, 1.1};
  medium.phase = HenyeyGreenstein{0.5};
  medium.emission = {0.02, 0.01, 0.03};
  scene.media = {medium};
  scene.background = {0.3, 0.2, 0.1};
  scene.ambient = {0.05, 0.06, 0.07};
  Directional sun;
  sun.direction = -toward;
  sun.irradiance = {3, 2.5, 2};
  scene.lights = {sun};
  Material red;
  red.albedo = {0.8, 0.3, 0.2};
  scene.objects = {{"ball", Sphere{{-0.25, -0.25, 0}, 0.4}, red},
                   {"another", Sphere{{0.9, 0.5, 0.9}, 0.3}, red}};
  scene.render.spp = 16;
  scene.render.samples_per_ray = 0;
  scene.render.threads = 1;
  return scene;
}

/// The same fog in two boxes that touch.
Scene cut_in_two(Scene scene) {
  scene.media.push_back(scene.media[0]);
  scene.media[0].shape = Box{{-1, -1, -1}, {1, 0.1, 1}};
  scene.media[1].shape = Box{{-1, 0.1, -1}, {1, 1, 1}};
  return scene;
}

/// The same fog inside triangles.
Scene in_triangles(Scene scene) {
  const test::TestMesh mesh = test::box_mesh({-1, -1, -1}, {1, 1, 1});
  scene.media[0].shape = Solid{close_mesh(mesh.points, mesh.triangles)};
  return scene;
}

void expect_same_pictures(const Scene& scene, const Scene& other, const std::string& what) {
  for (const char* estimator : {"closed_form", "rewv", "rm", "distance+difference", "mix+ratio"})
    for (const Kernel* kernel : available_kernels()) {
      if (estimator == std::string("closed_form") && kernel->isa != InstructionSet::reference)
        continue;
      const auto film_of = [&](const Scene& one) {
        RenderSettings settings = one.render;
        settings.estimator = estimator;
        settings.isa = kernel->isa;
        const Rendered rendered = Renderer(one).render(settings);
        EXPECT_EQ(rendered.rejected, 0);
        return rendered.film;
      };
      const Film a = film_of(scene), b = film_of(other);
      for (const char* layer : {"in_scatter", "surface", "transmittance", "depth"}) {
        const Image x = a.layer(layer), y = b.layer(layer);
        std::vector<double> differences;
        for (std::size_t i = 0; i < x.pixels.size(); ++i)
          differences.push_back(std::abs(x.pixels[i] - y.pixels[i]) /
                                std::max(1e-3f, std::abs(x.pixels[i])));
        std::ranges::sort(differences);
        // A sample on the other side of a shadow's edge changes one pixel of many.
        EXPECT_LT(differences[differences.size() * 95 / 100], 2e-5)
            << what << ", " << estimator << ", " << kernel->name << ", " << layer;
      }
    }
}

TEST(Pictures, show_no_seam_between_media_that_are_alike) {
  const Scene outside = box_scene({0.7, 0.9, 3.7}), inside = box_scene({0.3, 0.2, 0.9});
  expect_same_pictures(outside, cut_in_two(outside), "two boxes from outside");
  expect_same_pictures(inside, cut_in_two(inside), "two boxes from inside");
}

TEST(Pictures, show_the_same_fog_in_a_box_and_in_a_mesh) {
  const Scene outside = box_scene({0.7, 0.9, 3.7}), inside = box_scene({0.3, 0.2, 0.9});
  expect_same_pictures(outside, in_triangles(outside), "a mesh from outside");
  expect_same_pictures(inside, in_triangles(inside), "a mesh from inside");
}

TEST(Pictures, of_media_side_by_side_keep_to_their_closed_form) {
  Scene scene = box_scene({0.7, 0.9, 3.7});
  scene.media.push_back(scene.media[0]);
  scene.media[0].shape = Box{{-1, -1, -1}, {0.1, 1, 1}};
  scene.media[1].shape = Box{{0.1, -0.7, -0.8}, {1.2, 0.6, 1}};
  scene.media[1].sigma_t = {2, 0.9, 0.4};
  scene.media[1].sigma_s = {1.4, 0.7, 0.3};
  scene.media[1].phase = Rayleigh{};
  scene.render.estimator = "closed_form";
  const Film exact = Renderer(scene).render(scene.render).film;
  for (const char* estimator : {"rewv", "mcds", "mix+difference"}) {
    RenderSettings settings = scene.render;
    settings.estimator = estimator;
    settings.spp = 1024;
    const Film film = Renderer(scene).render(settings).film;
    Rgb<double> sum, truth;
    for (int y = 0; y < film.crop.height; ++y)
      for (int x = 0; x < film.crop.width; ++x)
        sum += film.radiance(x, y), truth += exact.radiance(x, y);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / truth[c], 1, 5e-4) << estimator;
  }
}

}  // namespace
}  // namespace airlight
