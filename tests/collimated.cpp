// Beams in fog, in every arithmetic: what the core knows of them in closed form against quadrature
// of an integrand that shares nothing with it, and the sums of every placement and form, among
// shadows, by z-test.

#include <airlight/in_scatter.h>
#include <gtest/gtest.h>

#include "support/quadrature.h"
#include "support/rays_in_a_box.h"
#include "support/stats.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::BoxRay;
using test::Random;
using Vector = Vec3<double>;

const Box unit_box;  // [-1, 1]^3, where local and world coordinates are the same

/// A ball that blocks light.
struct Ball {
  Vector centre;
  double radius = 0;

  template <Real F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> direction, F t_max, int, Mask<F>) const {
    const Vec3<F> q = from - Vec3<F>(centre);
    const F middle = -dot(q, direction);
    const Vec3<F> nearest = q + direction * middle;
    const F spare = F(Scalar<F>(radius * radius)) - dot(nearest, nearest);
    const F half = sqrt(max(spare, F(0)));
    const Mask<F> first = (middle - half > F(0)) & (middle - half < t_max);
    const Mask<F> second = (middle + half > F(0)) & (middle + half < t_max);
    return Rgb<F>(select((spare > F(0)) & (first | second), F(0), F(1)));
  }
};

/// A ray in the box and a beam, with the outline once more as a list of corners.
struct Case {
  BoxRay ray;
  Collimated beam;
  std::vector<Vec2<double>> corners;  ///< empty for a circle
  double sigma = 0;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    const Vector p = c.beam.position;
    return out << c.ray << " beam from {" << p.x << ", " << p.y << ", " << p.z << "} radius "
               << c.beam.cross_section.radius << " corners " << c.corners.size() << " sigma_t "
               << c.sigma;
  }
};

bool in_the_outline(const Case& c, double x, double y) {
  if (c.corners.empty()) return std::hypot(x, y) < c.beam.cross_section.radius;
  double turned = 0;  // by who follows the outline with his eyes
  for (std::size_t i = 0; i < c.corners.size(); ++i) {
    const auto [px, py] = c.corners[i];
    const auto [qx, qy] = c.corners[(i + 1) % c.corners.size()];
    turned += std::atan2((px - x) * (qy - y) - (py - y) * (qx - x),
                         (px - x) * (qx - x) + (py - y) * (qy - y));
  }
  return std::abs(turned) > 1;
}

/// How far a point is from the start plane; negative outside of the beam.
double distance_in(const Case& c, const Vector& p) {
  const Vector q = p - c.beam.position;
  return in_the_outline(c, dot(q, c.beam.right), dot(q, c.beam.up)) ? dot(q, c.beam.direction) : -1;
}

/// The parts of [0, t_max] where `is` holds, found by looking everywhere and halving.
template <class Predicate>
std::vector<std::pair<double, double>> parts_where(double t_max, Predicate&& is) {
  constexpr int steps = 4096;
  const auto border = [&](double a, double b) {
    const bool at_a = is(a);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (a + b);
      (is(middle) == at_a ? a : b) = middle;
    }
    return 0.5 * (a + b);
  };
  std::vector<std::pair<double, double>> parts;
  double before = 0;
  bool was = is(0.);
  if (was) parts.emplace_back(0, t_max);
  for (int i = 1; i <= steps; ++i) {
    const double t = t_max * i / steps;
    const bool now = is(t);
    if (now && !was) parts.emplace_back(border(before, t), t_max);
    if (!now && was) parts.back().second = border(before, t);
    before = t, was = now;
  }
  return parts;
}

/// ∫ e^{−σ (t + way to the light)} V dt over the part of the ray in the beam, by quadrature.
double integral_of(const Case& c, double sigma, const Ball& ball = {}) {
  const auto& [o, d, w, t_max] = c.ray;
  const auto lit = [&](double t) {
    const Vector p = o + d * t;
    const double reach = distance_in(c, p);
    return reach > 0 && ball.transmit<double>(p, w, reach, 0, true).r > 0;
  };
  // Where the way to the light may bend: distances along w to two planes agree.
  test::Body planes = test::box_body();
  planes.push_back({test::point(w), dot(w, c.beam.position)});
  std::vector<std::pair<double, double>> lines;
  for (const test::HalfSpace& plane : planes)
    if (const double facing = double(test::dot(plane.n, test::point(w))); facing > 0)
      lines.emplace_back(double(plane.h - test::dot(plane.n, test::point(o))) / facing,
                         double(-test::dot(plane.n, test::point(d))) / facing);
  std::vector<double> breaks;
  for (const auto& [a, b] : lines)
    for (const auto& [e, f] : lines)
      if (b != f) breaks.push_back((e - a) / (b - f));
  double sum = 0;
  for (const auto& [from, to] : parts_where(t_max, lit))
    sum += test::integrate(
        from, to,
        [&](double t) {
          const double out =
              double(test::exact_distance_out(planes, test::point(o + d * t), test::point(w)));
          return std::exp(-sigma * (t + out));
        },
        1e-12, breaks);
  return sum;
}

/// Corners of a convex polygon: points of an ellipse.
std::vector<Vec2<double>> polygon(Random& random) {
  const int n = 3 + random.below(6);
  const double a = random.log_uniform(0.1, 1.5), b = random.log_uniform(0.1, 1.5);
  const bool backwards = random.below(2) == 0;
  std::vector<Vec2<double>> corners;
  for (int i = 0; i < n; ++i) {
    const double turn = (backwards ? -1 : 1) * 2 * pi * (i + 0.8 * random.uniform()) / n;
    corners.push_back({a * std::cos(turn), b * std::sin(turn)});
  }
  return corners;
}

/// A beam that meets the ray about a random point of it, or nearly does, or just grazes it.
Case beam_at(const BoxRay& ray, Random& random) {
  Case c{.ray = ray, .beam = {}, .corners = {}, .sigma = random.log_uniform(1e-2, 30)};
  Collimated& beam = c.beam;
  beam.direction = -ray.w;
  Vector e1, e2;
  orthonormal_basis(ray.w, e1, e2);
  const double turn = random.uniform(0, 2 * pi);
  beam.up = e1 * std::cos(turn) + e2 * std::sin(turn);
  beam.right = cross(beam.direction, beam.up);
  Vector aside = random.in_the_cube() * random.log_uniform(1e-3, 1);
  switch (random.below(4)) {
    case 0:
      beam.cross_section = CrossSection::circle(random.log_uniform(0.05, 1.5));
      break;
    case 1: {  // a circle that the ray only just cuts
      beam.cross_section = CrossSection::circle(random.log_uniform(0.05, 1.5));
      const Vector across = cross(ray.d, ray.w);
      if (dot(across, across) > 1e-2)
        aside =
            normalize(across) * (beam.cross_section.radius * (1 - random.log_uniform(1e-6, 1e-2)));
      break;
    }
    case 2: {
      const double x = random.log_uniform(0.05, 1), y = random.log_uniform(0.05, 1);
      beam.cross_section = CrossSection::rectangle(2 * x, 2 * y);
      c.corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
      break;
    }
    default:
      c.corners = polygon(random);
      beam.cross_section = CrossSection::polygon(c.corners);
  }
  beam.position =
      ray.o + ray.d * (ray.t_max * random.uniform()) + aside + ray.w * random.uniform(-0.3, 3);
  return c;
}

std::vector<Case> cases(int n, double least, unsigned seed) {
  Random random(seed);
  std::vector<Case> result;
  for (const BoxRay& ray : test::rays_of_every_kind(n, least, seed))
    result.push_back(beam_at(ray, random));
  return result;
}

/// What the library says of a case.
template <Real F>
double found_integral(const Case& c) {
  const Medium medium{.sigma_s = {}, .sigma_t = Rgb<double>(c.sigma), .emission = {}};
  const auto space = unit_box.space();
  const LocalRay<F> entry{Vec3<F>(c.ray.o), Vec3<F>(c.ray.d)};
  const MediumRay<F> ray{.origin = entry.o,
                         .direction = entry.d,
                         .entry = entry,
                         .t_enter = F(0),
                         .t_max = F(Scalar<F>(c.ray.t_max)),
                         .active = F(0) == F(0)};
  const auto lit = lit_part(c.beam, medium, space, ray);
  Section<F, 1, std::remove_cvref_t<decltype(lit.space)>> section(
      lit.space, lit.ray.entry, Vec3<F>(c.beam.toward()), lit.ray.t_max, extinction<F, 1>(medium));
  section.trace_way_out();
  return double(lane(lit.ray.dimmed.r * section.integral[0], lanes<F> - 1));
}

template <class F>
class Beams : public testing::Test {};
TYPED_TEST_SUITE(Beams, test::Arithmetics, test::ArithmeticName);

TYPED_TEST(Beams, integrate_to_what_quadrature_says) {
  using F = TypeParam;
  constexpr bool in_double = std::same_as<F, double>;
  test::Worst error("T of a beam, absolute, over the length of the ray");
  int met = 0;
  // Less of w than 1e-2 makes the way out ill-conditioned in float.
  for (const Case& c : cases(in_double ? 40 : 15, in_double ? 1e-3 : 1e-2, 11)) {
    const double truth = integral_of(c, c.sigma);
    met += truth > 0;
    // A part that quadrature does not find is shorter than its steps.
    const double missed = truth > 0 ? 0 : c.ray.t_max / 4096;
    const double off = std::abs(found_integral<F>(c) - truth);
    error.see(c.ray.t_max > 0 ? std::max(off - missed, 0.) / c.ray.t_max : off, c);
  }
  EXPECT_GT(met, 100);
  // In float, ends of the part in the beam are known to a few roundings of coordinates over the
  // sine of the angle at which the ray meets the outline: worst where it grazes a circle, by
  // sqrt(1e-6) of the radius at least.
  error.expect_below(in_double ? 1e-10 : 2e-3);
}

TEST(Beams, along_the_ray_are_met_all_the_way_or_not_at_all) {
  Case c;
  c.ray = {{0.2, -1, 0.1}, {0, 1, 0}, {0, 1, 0}, 2};
  c.sigma = 0.7;
  c.beam.direction = {0, -1, 0};
  for (const double x : {0.2, 0.5, 0.9}) {
    for (const double start : {-0.5, 0.3, 5.}) {
      c.beam.position = {x, start, 0};
      c.beam.right = {1, 0, 0}, c.beam.up = {0, 0, -1};
      c.beam.cross_section = CrossSection::circle(0.35);
      // Against the light every way is as long: through the ray's first point to the start.
      const double end = std::min(start, 1.) + 1;
      const double truth = x < 0.6 ? end * std::exp(-c.sigma * end) : 0;
      EXPECT_NEAR(found_integral<double>(c), truth, 1e-14);
      EXPECT_NEAR(found_integral<float>(c), truth, 1e-6);
      c.beam.cross_section = CrossSection::rectangle(0.7, 0.7);
      EXPECT_NEAR(found_integral<double>(c), x < 0.6 ? end * std::exp(-c.sigma * end) : 0, 1e-14);
    }
  }
}

/// Calls judge with every placement; the mixture has two kinds.
template <class Judge>
void for_each_placement(Judge&& judge) {
  judge(Equidistant{}), judge(Distance{}), judge(WholeVolume{});
  judge(Mixed{Mixed::Partner::distance, 0.5}), judge(Mixed{Mixed::Partner::equidistant, 0.3});
}

TYPED_TEST(Beams, have_unbiased_sums_in_every_placement_and_form) {
  using F = TypeParam;
  constexpr int seeds = 64, samples = 1024;
  // The beam starts within the box; the ball shades a part of it.
  Case c;
  c.ray = {{-1, 0.1, 0.05}, normalize(Vector(1, 0.15, -0.1)), normalize(Vector(0.3, 1, 0.2)), 0};
  c.ray.t_max = 1.9;
  Vector e1, e2;
  orthonormal_basis(c.ray.w, e1, e2);
  c.beam.irradiance = {3, 2, 1};
  c.beam.direction = -c.ray.w;
  c.beam.up = e1, c.beam.right = cross(c.beam.direction, e1);
  c.beam.position = Vector(0.1, 0.2, 0) + c.ray.w * 0.6;
  c.beam.cross_section = CrossSection::circle(0.55);
  const Ball ball{Vector(0, 0.15, 0) + c.ray.w * 0.3, 0.2};

  double worst = 0;
  for (const bool rgb : {false, true}) {
    Medium medium;
    medium.sigma_s = rgb ? Rgb<double>(0.25, 0.8, 2.1) : Rgb<double>(0.8);
    medium.sigma_t = rgb ? Rgb<double>(0.3, 1, 3) : Rgb<double>(1.1);
    medium.phase = HenyeyGreenstein{0.5};
    Rgb<double> open, lit;
    for (int k = 0; k < 3; ++k) {
      const double strength =
          medium.sigma_s[k] * c.beam.irradiance[k] * evaluate(medium.phase, dot(c.ray.w, c.ray.d));
      open[k] = strength * integral_of(c, medium.sigma_t[k]);
      lit[k] = strength * integral_of(c, medium.sigma_t[k], ball);
    }
    ASSERT_LT(lit.g, 0.9 * open.g);
    const auto judge = [&](const Placements& placement, const Forms& form, bool per_step) {
      const Sampled estimator{placement, form, per_step};
      std::array<std::array<std::vector<double>, 3>, 4> values;
      const CameraRay<F> camera{Vec3<F>(c.ray.o), Vec3<F>(c.ray.d), F(Scalar<F>(c.ray.t_max))};
      for (int seed = 0; seed < seeds; seed += lanes<F>) {
        std::uint32_t hash[lanes<F>];
        for (int i = 0; i < lanes<F>; ++i) hash[i] = pixel_hash(7, std::uint32_t(seed + i), 0);
        const Estimate<F> e = in_scatter(estimator, medium, c.beam, camera, samples,
                                         Sampler<F>{load_bits<F>(hash)}, ball);
        const Rgb<F> sums[4] = {e.plain, e.analytic, e.occluded, e.unoccluded};
        for (int s = 0; s < 4; ++s)
          for (int k = 0; k < 3; ++k)
            for (int i = 0; i < lanes<F>; ++i) values[s][k].push_back(lane(sums[s][k], i));
      }
      const Estimate<double> want = std::visit([&](auto f) { return f(open, lit, open); }, form);
      const Rgb<double> sums[4] = {want.plain, want.analytic, want.occluded, want.unoccluded};
      for (int s = 0; s < 4; ++s)
        for (int k = 0; k < 3; ++k) {
          if (per_step && s > 0) continue;  // the plain march has no closed form
          if (sums[s][k] == 0) continue;
          EXPECT_LT(test::relative_standard_error(values[s][k]), 5e-4);
          const double rounding = (std::same_as<F, double> ? 1e-12 : 3e-6) * sums[s][k];
          const double z = test::z_score(values[s][k], sums[s][k], rounding);
          EXPECT_LT(std::abs(z), 4)
              << (rgb ? "RGB, " : "grey, ") << "sum " << s << ", channel " << k << ", "
              << std::visit([](auto p) { return p.name; }, placement) << "+"
              << std::visit([](auto f) { return f.name; }, form);
          worst = std::max(worst, std::abs(z));
        }
    };
    for (const Forms& form : {Forms(MonteCarlo{}), Forms(Ratio{}), Forms(Difference{})})
      for_each_placement([&](const Placements& placement) { judge(placement, form, false); });
    judge(Equidistant{}, MonteCarlo{}, true);
  }
  std::printf("[ measured ] worst z of a sum: %.2f\n", worst);
}

TEST(Beams, without_shadows_are_exact_with_one_sample) {
  Case c = cases(1, 1e-2, 3)[0];
  c.beam.position = c.ray.o + c.ray.d * (0.5 * c.ray.t_max) + c.ray.w * 0.4;
  Medium fog;
  fog.sigma_s = fog.sigma_t = {0.3, 1, 3};
  const CameraRay<double> camera{c.ray.o, c.ray.d, c.ray.t_max};
  const Sampler<double> sampler{pixel_hash(1, 2, 3)};
  const Rgb<double> exact = in_scatter(ClosedForm{}, fog, c.beam, camera, Unshadowed{});
  for (const Forms& form : {Forms(Ratio{}), Forms(Difference{})}) {
    const Rgb<double> found =
        in_scatter(Sampled{WholeVolume{}, form}, fog, c.beam, camera, 1, sampler, Unshadowed{})
            .radiance();
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(exact[k], 0);
      EXPECT_NEAR(found[k], exact[k], 1e-13 * exact[k]);
    }
  }
}

TEST(Beams, shine_in_fog_without_end) {
  Medium fog;
  fog.sigma_s = fog.sigma_t = Rgb<double>(0.5);
  fog.shape = Unbounded{};
  Collimated beam;
  beam.position = {0, 2, 0};
  beam.cross_section = CrossSection::rectangle(0.5, 0.5);
  EXPECT_EQ(ClosedForm{}.unsupported(fog, beam), nullptr);
  EXPECT_EQ(Sampled{}.unsupported(fog, beam), nullptr);
  // Across the beam, one metre below its start.
  const CameraRay<double> camera{{-3, 1, 0}, {1, 0, 0}};
  const double truth =
      0.5 / (4 * pi) * std::exp(-0.5) * std::exp(-0.5 * 2.75) * -std::expm1(-0.5 * 0.5) / 0.5;
  EXPECT_NEAR(in_scatter(ClosedForm{}, fog, beam, camera, Unshadowed{}).g, truth, 1e-14);
  // Along the beam, away from its start: ∫ e^{−2 σ t} dt.
  const CameraRay<double> along{{0, 2, 0}, {0, -1, 0}};
  EXPECT_NEAR(in_scatter(ClosedForm{}, fog, beam, along, Unshadowed{}).g,
              0.5 / (4 * pi) / (2 * 0.5), 1e-14);
}

TEST(Beams, with_an_image_have_no_closed_form) {
  Collimated beam;
  beam.image = 0;
  EXPECT_STREQ(ClosedForm{}.unsupported(Medium{}, beam),
               "closed_form is for beams without an image; give the beam another outline instead");
  EXPECT_EQ(Sampled{}.unsupported(Medium{}, beam), nullptr);
}

}  // namespace
}  // namespace airlight
