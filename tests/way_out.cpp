// The way out of a convex medium and the integral of transmittance along it, against quadrature and
// against brute force in long double, in every arithmetic.

#include "airlight/way_out.h"

#include <airlight/shapes.h>
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <utility>

#include "support/exact_way.h"
#include "support/gather.h"
#include "support/quadrature.h"
#include "support/rays_in_a_box.h"
#include "support/typed.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::BoxRay;
using test::Exact;
using test::ExactWay;
using test::gather;
using test::gather3;
using test::Point;
using test::point;
using test::Random;
using test::Worst;

/// A ray and the extinction along it.
struct Case {
  BoxRay ray;
  double sigma = 0;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.ray << " sigma_t " << c.sigma;
  }
};

std::vector<Case> cases(int n, double least, unsigned seed) {
  Random random(seed);
  std::vector<Case> result;
  for (const BoxRay& ray : test::rays_of_every_kind(n, least, seed))
    result.push_back({ray, test::any_sigma(random)});
  return result;
}

/// What the library says of a case.
struct Answer {
  double total, depth, t_max;
};

template <Real F, class Space>
std::vector<Answer> answers(const Space& space, const std::vector<Case>& all) {
  std::vector<Answer> result;
  for (std::size_t i = 0; i < all.size(); i += lanes<F>) {
    const LocalRay<F> ray{space.point(gather3<F>(all, i, [](const Case& c) { return c.ray.o; })),
                          space.vector(gather3<F>(all, i, [](const Case& c) { return c.ray.d; }))};
    const auto out =
        space.outward(space.vector(gather3<F>(all, i, [](const Case& c) { return c.ray.w; })));
    const F t_max = gather<F>(all, i, [](const Case& c) { return c.ray.t_max; });
    const auto way = space.way_out(ray, out, t_max);
    const Trapezoids<F, Space::max_segments> light(way, gather<F>(all, i, &Case::sigma));
    for (int k = 0; k < lanes<F> && i + std::size_t(k) < all.size(); ++k)
      result.push_back({lane(light.total, k), lane(light.depth, k), lane(way.t_max(), k)});
  }
  return result;
}

/// How far T is off, relative to itself, without ever forming the e^{−depth} that may underflow.
double relative_error(const Answer& answer, Exact sigma, const ExactWay& truth) {
  const Exact depth = sigma * truth.shortest();
  if (truth.t_max() == 0) return answer.total;
  return double(
      std::abs(answer.total / truth.integral(sigma) * std::exp(depth - Exact(answer.depth)) - 1));
}

/// Numbers as a float holds them.
Case narrowed(const Case& c, const test::Body& body = test::box_body()) {
  return {test::narrowed(c.ray, body), test::narrowed(c.sigma)};
}

std::vector<Case> narrowed(std::vector<Case> all) {
  for (Case& c : all) c = narrowed(c);
  return all;
}

/// T relative to its largest term by quadrature of an integrand that knows nothing of trapezoids.
/// However thin the layers at the ends that hold it all, some of these breaks fall into them.
double quadrature_of(const ExactWay& way, double sigma) {
  const double t_max = double(way.t_max());
  std::vector<double> breaks;
  for (double t = t_max / 2; t > t_max * 1e-7; t /= 4) breaks.insert(breaks.end(), {t, t_max - t});
  const Exact base = way.shortest();
  return test::integrate(
      0, t_max, [&](double t) { return double(std::exp(sigma * (base - way.length(t)))); }, 1e-13,
      breaks);
}

const Box unit_box;  // [-1, 1]^3, where local and world coordinates are the same

// ------------------------------------------------------------------------------------------------

TEST(ExactWay, agrees_with_quadrature) {
  // The judge of everything below, judged in its turn. The integrand is read at doubles t, hence
  // rounded by eps * depth.
  Worst worst("brute force against quadrature, relative error");
  for (const Case& c : cases(40, 0, 1)) {
    const ExactWay way = test::exact(c.ray);
    if (c.ray.t_max == 0) continue;
    worst.see(std::abs(quadrature_of(way, c.sigma) / double(way.integral(c.sigma)) - 1), c);
  }
  worst.expect_below(1e-11);
}

TEST(WayOutOfABox, holds_the_integral_of_transmittance) {
  const std::vector<Case> all = cases(2000, 1e-3, 2);
  const std::vector<Answer> found = answers<double>(unit_box.space(), all);
  Worst worst("T in double, relative error / (1 + depth)");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ExactWay way = test::exact(all[i].ray);
    const double depth = all[i].sigma * double(way.longest());
    worst.see(relative_error(found[i], all[i].sigma, way) / (1 + depth), all[i]);
  }
  worst.expect_below(1e-14);
}

TEST(WayOutOfABox, is_as_exact_as_its_condition_where_light_is_nearly_parallel_to_a_face) {
  const std::vector<Case> all = cases(2000, 0, 3);
  const std::vector<Answer> found = answers<double>(unit_box.space(), all);
  Worst worst("T in double, relative error / (1 + depth + sigma / least component of w)");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ExactWay way = test::exact(all[i].ray);
    double least = 1;
    for (int k = 0; k < 3; ++k)
      if (const double w = std::abs(all[i].ray.w[k]); w > 0) least = std::min(least, w);
    const double depth = all[i].sigma * double(way.longest());
    worst.see(relative_error(found[i], all[i].sigma, way) / (1 + depth + all[i].sigma / least),
              all[i]);
  }
  worst.expect_below(1e-15);
}

TEST(WayOutOfABox, keeps_its_accuracy_in_float) {
  const std::vector<Case> all = narrowed(cases(5000, 1e-2, 4));
  const std::vector<Answer> found = answers<float>(unit_box.space(), all);
  Worst relative("T in float, relative error / (1 + depth)");
  Worst absolute("T in float, absolute error / t_max");
  Worst thin("T in float where the depth is below 10, relative error");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Case& c = all[i];
    const ExactWay way = test::exact(c.ray);
    const double depth = c.sigma * double(way.longest());
    const double error = relative_error(found[i], c.sigma, way);
    relative.see(error / (1 + depth), c);
    if (depth < 10) thin.see(error, c);
    if (c.ray.t_max > 0) {
      const double t = found[i].total * std::exp(-found[i].depth);
      const double truth = double(way.integral(c.sigma) * std::exp(-c.sigma * way.shortest()));
      absolute.see(std::abs(t - truth) / c.ray.t_max, c);
    }
  }
  relative.expect_below(4e-6);
  thin.expect_below(1e-5);
  absolute.expect_below(2e-6);
}

TEST(WayOutOfABox, is_the_same_in_every_lane) {
  const std::vector<Case> all = narrowed(cases(2000, 1e-2, 5));
  const std::vector<Answer> one = answers<float>(unit_box.space(), all);
  const std::vector<Answer> many = answers<FloatBatch>(unit_box.space(), all);
  Worst worst("T of a lane against float, relative difference / (1 + depth)");
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(many[i].t_max, one[i].t_max);
    if (one[i].total == 0) {
      EXPECT_EQ(many[i].total, 0) << all[i];
      continue;
    }
    const double depth = all[i].sigma * double(test::exact(all[i].ray).longest());
    const double ratio = many[i].total / one[i].total * std::exp(one[i].depth - many[i].depth);
    worst.see(std::abs(ratio - 1) / (1 + depth), all[i]);
  }
  worst.expect_below(3e-6);  // as far as float may be from double, where only one of them fuses
}

TEST(WayOutOfABox, forgets_faces_all_but_parallel_to_the_light) {
  // In float a component of w below 1e-5 counts as zero. That can change the way only where the ray
  // is closer to the forgotten face than light gets towards it on its way out: 1e-5 of 2 sqrt(3).
  Random random(6);
  Worst effect("T of a forgotten face, absolute error beyond the stretch near it / t_max");
  Worst rounding("T against the exact T without that face, relative error / (1 + depth)");
  std::vector<Case> all;
  std::vector<int> face;
  for (BoxRay ray : test::rays_of_every_kind(1000, 1e-2, 6)) {
    const double tiny = random.log_uniform(1e-9, 0.99e-5) * random.sign();
    const int k = random.below(3);
    (k == 0 ? ray.w.x : k == 1 ? ray.w.y : ray.w.z) = 0;
    if (dot(ray.w, ray.w) == 0 || ray.t_max == 0) continue;
    ray.w = normalize(ray.w);
    (k == 0 ? ray.w.x : k == 1 ? ray.w.y : ray.w.z) = tiny;
    all.push_back(narrowed({ray, test::any_sigma(random)}));
    face.push_back(k);
  }
  const std::vector<Answer> found = answers<float>(unit_box.space(), all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Case& c = all[i];
    const ExactWay forgotten = test::exact(c.ray, parallel_below<float>), way = test::exact(c.ray);
    const double depth = c.sigma * double(forgotten.longest());
    rounding.see(relative_error(found[i], c.sigma, forgotten) / (1 + depth), c);

    const int k = face[i];
    const double off = 1 - std::copysign(c.ray.o[k], c.ray.o[k] * c.ray.w[k]), near = 3.5e-5;
    const double speed = c.ray.d[k] * std::copysign(1, c.ray.w[k]);  // off(t) = off - speed t
    double from = (off - near) / speed, to = (off + near) / speed;
    if (from > to) std::swap(from, to);
    if (std::abs(speed) < 1e-9) from = 0, to = std::abs(off) < near ? c.ray.t_max : 0;
    const double stretch = std::clamp(to, 0., c.ray.t_max) - std::clamp(from, 0., c.ray.t_max);
    const double t = found[i].total * std::exp(-found[i].depth);
    const double truth = double(way.integral(c.sigma) * std::exp(-c.sigma * way.shortest()));
    effect.see((std::abs(t - truth) - stretch) / c.ray.t_max, c);
  }
  effect.expect_below(1e-6);
  rounding.expect_below(2e-6);
}

TEST(WayOutOfABox, rises_and_falls_once_between_ascending_nodes) {
  for (const Case& c : cases(500, 0, 7)) {
    const Box::Space space = unit_box.space();
    const auto way = space.way_out<double>({c.ray.o, c.ray.d}, space.outward(c.ray.w), c.ray.t_max);
    EXPECT_EQ(way.t[0], 0);
    EXPECT_EQ(way.t_max(), c.ray.t_max);
    const ExactWay truth = test::exact(c.ray, parallel_below<double>);
    double slope = 1e300;
    for (int i = 0; i <= way.segments; ++i) {
      EXPECT_EQ(way.length[i], way.length_at(way.t[i]));
      if (i == 0) continue;
      ASSERT_GE(way.t[i], way.t[i - 1]) << c;
      const double wide = way.t[i] - way.t[i - 1];
      if (wide < 1e-6) continue;
      const double next = (way.length[i] - way.length[i - 1]) / wide;
      EXPECT_LE(next, slope + 1e-7 * std::abs(next)) << c;  // concave
      slope = next;
      // Straight between nodes.
      const double middle = 0.5 * (way.t[i] + way.t[i - 1]);
      const double length = double(truth.length(middle));
      EXPECT_NEAR(0.5 * (way.length[i] + way.length[i - 1]), length, 1e-6 * length) << c;
    }
  }
}

TEST(WayOutOfABox, can_be_clipped) {
  Random random(8);
  Worst worst("T of a part in double, relative error / (1 + depth)");
  for (const Case& c : cases(500, 1e-3, 8)) {
    const Box::Space space = unit_box.space();
    const auto way = space.way_out<double>({c.ray.o, c.ray.d}, space.outward(c.ray.w), c.ray.t_max);
    double from = c.ray.t_max * random.uniform(), to = c.ray.t_max * random.uniform();
    if (from > to) std::swap(from, to);
    const auto part = way.clipped(from, to);
    const Trapezoids<double, 3> light(part, c.sigma);
    const ExactWay truth = test::exact(c.ray);
    const Exact depth = c.sigma * (truth.shortest() - Exact(light.depth) / std::max(c.sigma, 1e-9));
    const Exact wanted = truth.integral(c.sigma, from, to);
    if (wanted > 0 && std::isfinite(double(std::exp(depth))))
      worst.see(double(std::abs(light.total / wanted * std::exp(depth) - 1)) /
                    (1 + c.sigma * double(truth.longest())),
                c);
  }
  worst.expect_below(3e-15);
}

// --- polyhedra ----------------------------------------------------------------------------------

/// A bounded polyhedron of 10 to 21 faces about a point, some of them twice or beside the body.
Convex random_convex(Random& random) {
  Convex convex;
  convex.centre = random.in_the_cube() * 2;
  const auto add = [&](const Vec3<double>& n, double above) {
    convex.faces[std::size_t(convex.face_count++)] = {n, dot(n, convex.centre) + above};
  };
  for (int k = 0; k < 3; ++k) {
    const Vec3<double> axis(k == 0, k == 1, k == 2);
    add(axis, random.uniform(0.3, 1.5));
    add(-axis, random.uniform(0.3, 1.5));
  }
  const int wanted = 10 + random.below(12);
  while (convex.face_count < wanted) {
    if (random.below(8) == 0)
      convex.faces[std::size_t(convex.face_count)] =
          convex.faces[std::size_t(random.below(convex.face_count))],
      ++convex.face_count;
    else
      add(random.direction(), random.uniform(0.3, 2));
  }
  return convex;
}

test::Body body_of(const Convex& convex) {
  test::Body body;
  for (int k = 0; k < convex.face_count; ++k) {
    const Plane& face = convex.faces[std::size_t(k)];
    body.push_back({point(face.n), face.h});
  }
  return body;
}

/// A ray that starts inside, or outside and is moved to where it enters; t_max at the exit or
/// before.
BoxRay ray_in(const test::Body& body, const Vec3<double>& centre, Random& random) {
  BoxRay ray{centre, random.direction(), random.direction()};
  const auto way = [&](const Vec3<double>& p, const Vec3<double>& towards) {
    return double(test::exact_distance_out(body, point(p), point(towards)));
  };
  const Vec3<double> aside = random.direction();
  ray.o = centre + aside * (way(centre, aside) * random.uniform());
  switch (random.below(6)) {
    case 0:
      ray.w = ray.d;
      break;
    case 1:
      ray.w = -ray.d;
      break;
    case 2:
      ray.o = ray.o - ray.d * way(ray.o, -ray.d);
      break;  // on the boundary
    default:
      break;
  }
  ray.t_max = way(ray.o, ray.d);
  if (random.below(2) == 0) ray.t_max *= random.uniform();
  return ray;
}

/// By what rounding is magnified: the depth, and the extinction times how far a coordinate's
/// rounding moves the boundary along w.
double condition(const test::Body& body, const Case& c, const ExactWay& way) {
  Exact least = 1;
  for (const test::HalfSpace& face : body)
    if (const Exact facing = test::dot(face.n, point(c.ray.w)); facing > 0)
      least = std::min(least, facing);
  return double(1 + c.sigma * way.longest() + c.sigma * (1 + length(c.ray.o)) / least);
}

TEST(WayOutOfAPolyhedron, holds_the_integral_of_transmittance) {
  Random random(9);
  Worst in_double("T in double, relative error / condition");
  Worst in_float("T in float, relative error / condition");
  Worst in_lanes("T of a lane against float, relative difference / condition");
  Worst quadrature("T in double against quadrature, relative error");
  for (int body_index = 0; body_index < 400; ++body_index) {
    Convex convex = random_convex(random);
    test::Body body = body_of(convex);
    std::vector<Case> all;
    while (all.size() < 16) {
      const BoxRay ray = ray_in(body, convex.centre, random);
      if (std::ranges::all_of(body, [&](const test::HalfSpace& face) {
            return std::abs(test::dot(face.n, point(ray.w))) > 1e-3;
          }))
        all.push_back({ray, test::any_sigma(random)});
    }
    const auto truth_of = [&](const BoxRay& ray) {
      return ExactWay(body, point(ray.o), point(ray.d), point(ray.w), ray.t_max);
    };
    const auto check = [&](const std::vector<Answer>& found, Worst& worst) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const ExactWay truth = truth_of(all[i].ray);
        worst.see(relative_error(found[i], all[i].sigma, truth) / condition(body, all[i], truth),
                  all[i]);
      }
    };
    const std::vector<Answer> found = answers<double>(convex.space(), all);
    check(found, in_double);
    if (body_index < 60) {
      const ExactWay truth = truth_of(all[0].ray);
      const double depth = all[0].sigma * double(truth.shortest());
      quadrature.see(std::abs(found[0].total / quadrature_of(truth, all[0].sigma) *
                                  std::exp(depth - found[0].depth) -
                              1),
                     all[0]);
    }

    // In float the same body with planes that float can hold, about the origin.
    for (int k = 0; k < convex.face_count; ++k) {
      Plane& face = convex.faces[std::size_t(k)];
      face.h = float(face.h - dot(face.n, convex.centre));
      face.n = Vec3<double>(float(face.n.x), float(face.n.y), float(face.n.z));
    }
    const Vec3<double> centre = std::exchange(convex.centre, {});
    body = body_of(convex);
    for (Case& c : all) {
      c.ray.o = c.ray.o - centre;
      c = narrowed(c, body);
    }
    const std::vector<Answer> one = answers<float>(convex.space(), all);
    check(one, in_float);
    const std::vector<Answer> many = answers<FloatBatch>(convex.space(), all);
    for (std::size_t i = 0; i < all.size(); ++i)
      in_lanes.see(
          std::abs(many[i].total / one[i].total * std::exp(one[i].depth - many[i].depth) - 1) /
              condition(body, all[i], truth_of(all[i].ray)),
          all[i]);
  }
  in_double.expect_below(2e-15);
  quadrature.expect_below(1e-9);  // it errs, not T, where many kinks lie close together
  in_float.expect_below(1e-6);
  in_lanes.expect_below(1e-6);
}

// --- boundaries ---------------------------------------------------------------------------------

/// The largest t <= `far` up to which p + t w is inside, by bisection on nothing but the predicate.
double last_inside(const test::Body& body, const Point& p, const Point& w, double far) {
  double in = 0, out = far;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (in + out);
    (test::is_inside(body, test::along(p, w, middle)) ? in : out) = middle;
  }
  return in;
}

template <class Shape>
void check_boundaries(const Shape& shape, const test::Body& body, const Vec3<double>& centre,
                      Random& random, Worst& distance, Worst& ends) {
  const auto space = shape.space();
  for (int i = 0; i < 20; ++i) {
    const BoxRay ray = ray_in(body, centre, random);
    const Vec3<double> p = ray.o + ray.d * (0.5 * ray.t_max);
    const LocalRay<double> on{space.point(p), space.vector(ray.d)};
    const double found =
        space.way_out(on, space.outward(space.vector(ray.w)), 0.1 * ray.t_max).distance_out(0.);
    distance.see(std::abs(found - last_inside(body, point(p), point(ray.w), 100)), ray);

    // From outside towards the body, past it, or from inside it.
    const Vec3<double> eye = random.below(4) == 0 ? p : centre + random.direction() * 12.;
    const Vec3<double> target = centre + random.in_the_cube() * 3;
    const Vec3<double> d = normalize(target - eye);
    const Interval<double> clip = space.clip(LocalRay<double>{space.point(eye), space.vector(d)});
    EXPECT_GE(clip.t_enter, 0);
    for (int k = 0; k <= 200; ++k) {
      const double t = k * 0.1;
      const Point q = test::along(point(eye), point(d), t);
      const bool within = t >= clip.t_enter && t <= clip.t_exit;
      EXPECT_TRUE(within ? test::is_inside(body, q, 1e-12) : !test::is_inside(body, q, -1e-12))
          << "t " << t << " of [" << clip.t_enter << ", " << clip.t_exit << "]";
    }
    if (clip.t_exit > clip.t_enter + 1e-6) {
      // From the middle outwards, both ways, the predicate changes at the ends.
      const double middle = 0.5 * (clip.t_enter + clip.t_exit);
      const Point m = test::along(point(eye), point(d), middle);
      const double ahead = last_inside(body, m, point(d), 100);
      const double behind = std::min(last_inside(body, m, point(-d), 100), middle);
      ends.see(std::max(std::abs(middle + ahead - clip.t_exit),
                        std::abs(middle - behind - clip.t_enter)),
               clip.t_enter);
    }
  }
}

/// A box turned about x, then y, then z, written as one would say it.
test::Body turned_box(const Box& box) {
  const auto turn = [](Point v, int axis, double degrees) {
    const Exact angle = degrees * (std::acos(Exact(-1)) / 180);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const Exact c = std::cos(angle), s = std::sin(angle);
    Point result = v;
    result[i] = c * v[i] - s * v[j];
    result[j] = s * v[i] + c * v[j];
    return result;
  };
  const Vec3<double> centre = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
  test::Body body;
  for (int k = 0; k < 3; ++k)
    for (int sign : {-1, 1}) {
      Point n{};
      n[k] = sign;
      for (int axis = 0; axis < 3; ++axis) n = turn(n, axis, box.rotation[axis]);
      body.push_back({n, test::dot(n, point(centre)) + Exact(half[k])});
    }
  return body;
}

Box random_box(Random& random) {
  Box box;
  const Vec3<double> centre = random.in_the_cube();
  const Vec3<double> half(random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2));
  box.min = centre - half, box.max = centre + half;
  if (random.below(4) != 0)
    box.rotation = {random.uniform(-180, 180), random.uniform(-180, 180),
                    random.uniform(-180, 180)};
  return box;
}

TEST(Box, ends_where_its_inside_ends) {
  Random random(10);
  Worst distance("distance out against bisection [m]"),
      ends("ends of a clip against bisection [m]");
  for (int i = 0; i < 60; ++i) {
    const Box box = random_box(random);
    check_boundaries(box, turned_box(box), (box.min + box.max) * 0.5, random, distance, ends);
  }
  distance.expect_below(5e-14);
  ends.expect_below(2e-13);
}

TEST(Convex, ends_where_its_inside_ends) {
  Random random(11);
  Worst distance("distance out against bisection [m]"),
      ends("ends of a clip against bisection [m]");
  for (int i = 0; i < 60; ++i) {
    const Convex convex = random_convex(random);
    check_boundaries(convex, body_of(convex), convex.centre, random, distance, ends);
  }
  distance.expect_below(5e-14);
  ends.expect_below(2e-13);
}

/// Rays parallel to faces of the cube [-1, 1]^3: into it and past it.
template <class Shape>
void check_parallel_rays(const Shape& shape) {
  const auto cube = shape.space();
  const test::Body body = test::box_body();
  for (const double x : {-1.5, -0.5, 0., 0.9, 1.1, 3.})
    for (const double y : {-2., -0.3, 0.5, 1.5})
      for (const double z : {-4., -0.7, 0.1, 2.})
        for (const Vec3<double>& d :
             {Vec3<double>(1, 0, 0), Vec3<double>(0, -1, 0), Vec3<double>(0, 0, 1),
              Vec3<double>(0.6, 0.8, 0), Vec3<double>(0, -0.6, 0.8), Vec3<double>(-0.8, 0, -0.6)}) {
          const Vec3<double> eye(x, y, z);
          const Interval<double> inside =
              cube.clip(LocalRay<double>{cube.point(eye), cube.vector(d)});
          for (double t = 0.013; t < 10; t += 0.1)
            EXPECT_EQ(t > inside.t_enter && t < inside.t_exit,
                      test::is_inside(body, test::along(point(eye), point(d), t)))
                << "from " << x << " " << y << " " << z << " at " << t;
        }
}

TEST(Box, is_hit_or_missed_by_rays_parallel_to_its_faces) { check_parallel_rays(unit_box); }

TEST(Convex, is_hit_or_missed_by_rays_parallel_to_its_faces) {
  Convex cube;
  for (const test::HalfSpace& face : test::box_body())
    cube.faces[std::size_t(cube.face_count++)] = {
        {double(face.n[0]), double(face.n[1]), double(face.n[2])}, double(face.h)};
  check_parallel_rays(cube);
}

TEST(Box, is_a_convex_of_six_faces) {
  Random random(12);
  Worst worst("T of a turned box against a polyhedron, relative difference / (1 + depth)");
  for (int i = 0; i < 300; ++i) {
    const Box box = random_box(random);
    const test::Body body = turned_box(box);
    Convex convex;
    convex.centre = (box.min + box.max) * 0.5;
    for (const test::HalfSpace& face : body)
      convex.faces[std::size_t(convex.face_count++)] = {
          {double(face.n[0]), double(face.n[1]), double(face.n[2])}, double(face.h)};
    std::vector<Case> all;
    while (all.size() < 10) {
      const BoxRay ray = ray_in(body, convex.centre, random);
      bool parallel = false;
      for (const test::HalfSpace& face : body)
        parallel |= std::abs(test::dot(face.n, point(ray.w))) < 1e-3;
      if (!parallel) all.push_back({ray, test::any_sigma(random)});
    }
    const std::vector<Answer> a = answers<double>(box.space(), all);
    const std::vector<Answer> b = answers<double>(convex.space(), all);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const ExactWay way(body, point(all[k].ray.o), point(all[k].ray.d), point(all[k].ray.w),
                         all[k].ray.t_max);
      const double depth = all[k].sigma * double(way.longest());
      worst.see(
          std::abs(a[k].total / b[k].total * std::exp(b[k].depth - a[k].depth) - 1) / (1 + depth),
          all[k]);
    }
  }
  worst.expect_below(1e-13);
}

TEST(Unbounded, lets_no_light_in_from_far_away) {
  const Unbounded::Space space = Unbounded{}.space();
  const LocalRay<double> ray{{1, 2, 3}, {0, 0, 1}};
  EXPECT_EQ(space.clip(ray).t_enter, 0);
  EXPECT_GE(space.clip(ray).t_exit, 1e18);
  const Trapezoids<double, 1> light(space.way_out(ray, space.outward(ray.d), 5.), 1e-6);
  EXPECT_EQ(light.transmittance_integral(), 0);
}

// --- what nobody would write into a scene -------------------------------------------------------

template <class F>
class EveryArithmetic : public ::testing::Test {};
TYPED_TEST_SUITE(EveryArithmetic, test::Arithmetics, test::ArithmeticName);

/// A number of any kind that a coordinate may take, down to those that flush to zero.
double odd_number(Random& random) {
  static constexpr double numbers[] = {0,     -0.,   1,     -1,       1e-3,        1e-7, 1e-20,
                                       1e-30, 1e-38, 1e-42, 1 - 1e-7, 1 - 0x1p-24, 0.5};
  return random.below(2) == 0 ? random.of(numbers) * random.sign() : random.uniform(-1, 1);
}

Vec3<double> odd_direction(Random& random) {
  for (;;) {
    const Vec3<double> v(odd_number(random), odd_number(random), odd_number(random));
    if (dot(v, v) < 1e-3) continue;  // a direction has unit length before it gets here
    const Vec3<double> unit = normalize(v);
    return unit;
  }
}

template <Real F, class Space>
void torture(const Space& space, unsigned seed, int rounds) {
  static constexpr double sigmas[] = {0, 1e-38, 1e-30, 1e-7, 1e-3, 0.1, 1, 10, 1e3, 1e6};
  static constexpr double shortest[] = {0, 1e-42, 1e-38, 1e-30, 1e-10, 1e-7, 1e-3};
  static constexpr double us[] = {0, 1e-30, 0.5, 1 - 0x1p-24, 1};
  // Rounding may carry the sum of three segments past t_max.
  const double slack = 1 + 4 * double(std::numeric_limits<Scalar<F>>::epsilon());
  const auto is_fine = [](double x, double most) { return x >= 0 && x <= most; };
  Random random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<Case> all;
    for (int i = 0; i < lanes<F>; ++i) {
      BoxRay ray{{odd_number(random), odd_number(random), odd_number(random)},
                 odd_direction(random),
                 random.below(8) == 0 ? Vec3<double>() : odd_direction(random)};
      if (dot(ray.w, ray.w) == 0) ray.w = random.below(2) == 0 ? ray.d : -ray.d;
      if (random.below(8) == 0) ray.o = ray.o + odd_direction(random) * 3.;
      ray.t_max = random.below(3) == 0 ? random.of(shortest) : 1e9;
      all.push_back({ray, random.of(sigmas)});
    }
    LocalRay<F> ray{space.point(gather3<F>(all, 0, [](const Case& c) { return c.ray.o; })),
                    space.vector(gather3<F>(all, 0, [](const Case& c) { return c.ray.d; }))};
    const auto out =
        space.outward(space.vector(gather3<F>(all, 0, [](const Case& c) { return c.ray.w; })));
    const Interval<F> inside = space.clip(ray);
    const Mask<F> hit = inside.t_exit > inside.t_enter;
    const F enter = select(hit, inside.t_enter, F(0));
    ray.o = ray(enter);
    const F t_max = select(
        hit,
        min(gather<F>(all, 0, [](const Case& c) { return c.ray.t_max; }), inside.t_exit - enter),
        F(0));
    const F sigma = gather<F>(all, 0, &Case::sigma);
    const auto way = space.way_out(ray, out, t_max);
    const Trapezoids<F, Space::max_segments> light(way, sigma);
    F samples[std::size(us)], densities[std::size(us)];
    for (std::size_t k = 0; k < std::size(us); ++k) {
      samples[k] = light.sample(way, F(Scalar<F>(us[k])));
      densities[k] = light.pdf(way.length_at(samples[k]), sigma);
    }
    for (int i = 0; i < lanes<F>; ++i) {
      const double far = lane(t_max, i);
      ASSERT_TRUE(std::isfinite(far) && far >= 0) << all[std::size_t(i)];
      ASSERT_TRUE(is_fine(lane(light.total, i), far * slack))
          << all[std::size_t(i)] << ": total " << lane(light.total, i) << " of " << far;
      ASSERT_TRUE(far < 1e-37 || lane(light.total, i) > 0) << all[std::size_t(i)];
      ASSERT_TRUE(is_fine(lane(light.transmittance_integral(), i), far * slack))
          << all[std::size_t(i)];
      ASSERT_TRUE(is_fine(lane(light.depth, i), 1e30)) << all[std::size_t(i)];
      for (int s = 0; s <= way.segments; ++s) {
        ASSERT_TRUE(is_fine(lane(way.t[s], i), far)) << all[std::size_t(i)];
        ASSERT_TRUE(is_fine(lane(way.length[s], i), 1e20)) << all[std::size_t(i)];
      }
      double before = 0;
      for (std::size_t k = 0; k < std::size(us); ++k) {
        const double t = lane(samples[k], i);
        ASSERT_TRUE(is_fine(t, far)) << all[std::size_t(i)] << ": u " << us[k] << " gives " << t;
        ASSERT_GE(t * slack, before) << all[std::size_t(i)] << ": u " << us[k];
        // The density of a point within a stretch of 1e-42 is more than a float can hold.
        ASSERT_TRUE(is_fine(lane(densities[k], i), far > 1e-37 ? 1e37 : INFINITY))
            << all[std::size_t(i)];
        before = t;
      }
    }
  }
}

template <Real F>
void torture_all() {
  torture<F>(unit_box.space(), 13, 20'000);
  Box box;
  box.rotation = {30, 45, 60};
  torture<F>(box.space(), 14, 10'000);
  Random random(15);
  for (int i = 0; i < 20; ++i) torture<F>(random_convex(random).space(), 16 + unsigned(i), 100);
}

TYPED_TEST(EveryArithmetic, survives_odd_numbers) { torture_all<TypeParam>(); }

TYPED_TEST(EveryArithmetic, survives_odd_numbers_where_denormals_flush_to_zero) {
  const unsigned mode = _mm_getcsr();
  _mm_setcsr(mode | 0x8040);  // as the renderer's threads run
  torture_all<TypeParam>();
  _mm_setcsr(mode);
}

}  // namespace
}  // namespace airlight
