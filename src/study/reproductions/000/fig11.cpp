#include <airlight/section.h>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "image/metrics.h"
#include "render/render.h"
#include "scene/polyhedron.h"
#include "study/brute_force.h"
#include "study/reproduction.h"

namespace airlight::paper_000 {
namespace {

constexpr double golden = 1.618033988749894848;

/// The regular dodecahedron with corners at distance √3 m.
Convex dodecahedron() {
  std::vector<Vec3<double>> corners;
  for (double a : {-1., 1.})
    for (double b : {-1., 1.}) {
      for (double c : {-1., 1.}) corners.push_back({a, b, c});
      corners.push_back({0, a / golden, b * golden});
      corners.push_back({a / golden, b * golden, 0});
      corners.push_back({b * golden, 0, a / golden});
    }
  return hull_of(corners);
}

/// The regular icosahedron with corners at distance 1.9 m.
Convex icosahedron() {
  std::vector<Vec3<double>> corners;
  for (double a : {-1., 1.})
    for (double b : {-golden, golden}) {
      corners.push_back({0, a, b});
      corners.push_back({a, b, 0});
      corners.push_back({b, 0, a});
    }
  return hull_of(corners);
}

struct Accuracy {
  int rays = 0, most_segments = 0;
  double worst = 0;  ///< relative error of T
};

/// T in closed form against quadrature, for random rays that start in or about the body, random
/// lights, and extinctions from 0.05 to 5 /m.
Accuracy accuracy(const Convex& body, int rays) {
  std::mt19937_64 random(11);
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * std::ldexp(double(random() >> 11), -53);
  };
  const auto direction = [&] {
    const double z = uniform(-1, 1), turn = uniform(0, 2 * pi), r = std::sqrt(1 - z * z);
    return Vec3<double>{r * std::cos(turn), r * std::sin(turn), z};
  };
  const std::vector<Plane> faces = faces_of(body);
  const Convex::Space space = body.space();
  Accuracy result;
  while (result.rays < rays) {
    const Vec3<double> origin{uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
    const Vec3<double> target{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const Vec3<double> d = normalize(target - origin), w = direction();
    const double sigma_t = 0.05 * std::pow(100, uniform(0, 1));
    const Interval<double> inside = BruteForceRay::inside(faces, origin, d);
    const double t_max = inside.t_exit - inside.t_enter;
    if (!(t_max > 1e-3)) continue;
    const Vec3<double> entry = origin + d * inside.t_enter;
    const double exact = BruteForceRay{faces, entry, d, w, t_max, sigma_t}.transmittance_integral();
    Section<double, 1, Convex::Space> section(space, {space.point(entry), space.vector(d)},
                                              space.vector(w), t_max, {sigma_t});
    section.trace_way_out();
    result.worst = std::max(result.worst, std::abs(section.integral[0] / exact - 1));
    result.most_segments = std::max(result.most_segments, section.way.segments);
    ++result.rays;
  }
  return result;
}

/// Fog of the given shape with a ball and a ring of beads in it, lit from the upper right.
Scene fog_with_beads(const Convex& shape) {
  Scene scene;
  scene.resolution = {320, 320};
  scene.camera = {.position = {1.2, 1.4, 5.6}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov = 37};
  scene.background = Rgb<double>(0.03);
  Medium fog;
  fog.sigma_t = fog.sigma_s = Rgb<double>(0.9);
  fog.shape = shape;
  scene.media = {fog};
  Directional sun;
  sun.irradiance = Rgb<double>(11);
  sun.direction = normalize(Vec3<double>(-0.75, -1, -0.1));
  scene.lights = {sun};
  Material paint;
  paint.albedo = Rgb<double>(0.4);
  scene.objects = {{"ball", Sphere{{0, 0.1, 0}, 0.42}, paint}};
  constexpr int beads = 8;
  for (int i = 0; i < beads; ++i) {
    const double turn = 2 * pi * i / beads;
    scene.objects.push_back(
        {"bead", Sphere{{0.95 * std::cos(turn), 0.35, 0.95 * std::sin(turn)}, 0.17}, paint});
  }
  scene.render.samples_per_ray = 0;
  scene.render.visibility = Visibility::analytic;
  return scene;
}

}  // namespace

/// Figure 11: convex media other than boxes.
void fig11(Reproduced& out) {
  struct Body {
    const char* name;
    Convex shape;
    int faces;
  };
  const Body bodies[] = {{"dodecahedron", dodecahedron(), 12}, {"icosahedron", icosahedron(), 20}};
  constexpr int rays = 4000;

  std::vector<Figure> pictures;
  Table table{.caption = "PSNR of the pictures against the exact ones."};
  table.columns = {{.name = "medium"},
                   {.name = "estimator"},
                   {.name = "PSNR", .unit = "dB", .best = Best::highest}};
  table.group_by = 0;
  for (const Body& body : bodies) {
    const Accuracy measured = accuracy(body.shape, rays);
    const std::string name = body.name;
    out.rows.push_back({name + ": faces",
                        {},
                        double(body.shape.face_count),
                        double(body.faces),
                        double(body.faces)});
    out.rows.push_back({fmt::format("{}: largest relative error of T over {} rays", name, rays),
                        {},
                        measured.worst,
                        0,
                        1e-9});

    const Scene scene = fog_with_beads(body.shape);
    Renderer renderer(scene);
    RenderSettings settings = scene.render;
    settings.spp = 1;
    settings.estimator = "closed_form";
    const Image exact = renderer.render(settings).film.layer("beauty");
    for (const char* estimator : {"rm", "mcwvds", "reds"}) {
      settings.estimator = estimator;
      const Image image = renderer.render(settings).film.layer("beauty");
      const double psnr = compare(image, exact).psnr;
      table.rows.push_back({name, estimator, psnr});
      pictures.push_back(out.picture(fmt::format("{}_{}", name, estimator), image,
                                     fmt::format("{}, {}, 1 spp", name, estimator)));
    }
    pictures.push_back(out.picture(name + "_exact", exact, name + ", exact"));
  }

  out.page.paragraph(
      "The way from the camera to a point and on to where light enters is concave and piecewise "
      "linear in every convex medium, with at most one piece for each face, usually one to three. "
      "So T, its samples and every estimator are those of the box. T is held here against "
      "adaptive quadrature of e^{−τ(t)}, with the distance to the boundary found face by face at "
      "every point: random rays, lights and extinctions from 0.05 to 5 /m.");
  out.page.checks(out.rows, "The paper shows pictures and prints no numbers.");
  out.page.figures(pictures, 4, "One sample a pixel, as in the paper, and the exact picture.");
  out.page.table(table);
}

}  // namespace airlight::paper_000
