// Media side by side: what of the light that their union scatters reaches the camera, in pieces,
// against quadrature of an integrand that measures every way afresh, in every arithmetic.

#include <airlight/joined.h>
#include <airlight/lit_part.h>
#include <airlight/placements.h>
#include <gtest/gtest.h>

#include <memory>

#include "report/statistics.h"
#include "support/sections_in_pieces.h"
#include "support/stats.h"
#include "support/unions.h"
#include "support/worst.h"

namespace airlight {
namespace {

using test::Exact;
using test::nearly_parallel;
using test::Random;
using test::section_of;
using test::Union;
using test::Worst;

/// A box to be cut up.
struct Cell {
  Vec3<double> min{-1, -1, -1}, max{1, 1, 1};
};

double& component(Vec3<double>& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

/// [-1, 1]^3 cut into boxes that touch; some are then shrunk.
std::vector<Cell> cells(Random& random, int n) {
  std::vector<Cell> all(1);
  while (int(all.size()) < n) {
    const std::size_t i = std::size_t(random.below(int(all.size())));
    Cell rest = all[i];
    const int k = random.below(3);
    const double low = component(rest.min, k), high = component(rest.max, k);
    const double at = low + (high - low) * random.uniform(0.3, 0.7);
    component(all[i].max, k) = component(rest.min, k) = at;
    all.push_back(rest);
  }
  for (Cell& cell : all)
    if (random.below(2)) {
      const Vec3<double> middle = (cell.min + cell.max) * 0.5;
      cell = {middle + (cell.min - middle) * 0.8, middle + (cell.max - middle) * 0.8};
    }
  return all;
}

Medium any_medium(Random& random, const Cell& cell, bool grey) {
  Medium medium;
  medium.shape = Box{cell.min, cell.max};
  for (int c = 0; c < 3; ++c) {
    medium.sigma_t[c] = grey && c > 0 ? medium.sigma_t.r : random.log_uniform(0.05, 10);
    medium.sigma_s[c] = grey && c > 0 ? medium.sigma_s.r : medium.sigma_t[c] * random.uniform();
  }
  if (random.below(2)) medium.phase = HenyeyGreenstein{random.uniform(-0.8, 0.8)};
  return medium;
}

/// Kinds of rays in which the union is well-conditioned.
constexpr test::Kind kinds[] = {test::Kind::generic,
                                test::Kind::into_the_light,
                                test::Kind::light_behind,
                                test::Kind::light_along_an_axis,
                                test::Kind::view_along_an_axis,
                                test::Kind::both_along_axes,
                                test::Kind::light_parallel_to_a_face,
                                test::Kind::view_parallel_to_a_face,
                                test::Kind::both_parallel_to_faces,
                                test::Kind::gliding_in_a_face,
                                test::Kind::from_a_corner,
                                test::Kind::tied};
/// One to six boxes along the axes and a ray from inside them or from outside.
template <class Kinds>
Union any_union(Random& random, const Kinds& which, bool grey) {
  Union all;
  for (const Cell& cell : cells(random, 1 + random.below(6)))
    all.parts.push_back({test::box_body(test::point(cell.min), test::point(cell.max)),
                         any_medium(random, cell, grey)});
  all.ray = test::any_ray(random, random.of(which));
  all.start = test::any_start(random, all.ray, 4);
  return all;
}

std::vector<Medium> media_of(const Union& all) {
  std::vector<Medium> media;
  for (const Union::Part& part : all.parts) media.push_back(part.medium);
  return media;
}

/// A union with its section in double, which stays where it is made.
struct Traced {
  explicit Traced(Union all_) : all(std::move(all_)) {}
  Traced(const Traced&) = delete;

  Union all;
  std::vector<Medium> media = media_of(all);
  Joined joined{media};
  SpaceBelowStart<double, Joined> below{joined, all.start.a, all.start.b};
  Section<double, 3, SpaceBelowStart<double, Joined>> section =
      section_of<double, 3>(below, all.ray, media[0]);
};

/// Unions of which the ray sees something in every channel.
template <class Kinds>
std::vector<std::unique_ptr<Traced>> traced(int n, const Kinds& which, unsigned seed) {
  Random random(seed);
  std::vector<std::unique_ptr<Traced>> result;
  while (int(result.size()) < n) {
    auto one = std::make_unique<Traced>(any_union(random, which, false));
    const auto& total = one->section.pieces.total;
    if (std::min({total[0], total[1], total[2]}) > 1e-9) result.push_back(std::move(one));
  }
  return result;
}

template <class Kinds>
void expect_exact(const char* what, const Kinds& which, double allowed, int n) {
  Worst worst(what);
  for (const auto& one : traced(n, which, 1))
    for (int c = 0; c < 3; ++c) {
      const auto& [all, media, joined, below, section] = *one;
      const Exact base = all.least_depth(c);
      const double found =
          section.pieces.total[c] * double(std::exp(base - Exact(section.pieces.depth[c])));
      const double truth = all.integral(c, base, 0, all.ray.t_max);
      worst.see(std::abs(found / truth - 1) / (1 + double(base)), all);
    }
  worst.expect_below(allowed);
}

TEST(JoinedMedia, hold_the_integral_of_what_scatters) {
  expect_exact("T of a union in double, relative error / (1 + depth)", kinds, 1.5e-13, 320);
}

TEST(JoinedMedia, are_as_exact_as_their_condition_where_the_light_all_but_follows_the_ray) {
  expect_exact("T of a union where w is all but d, relative error / (1 + depth)", nearly_parallel,
               1e-13, 80);
}

TEST(JoinedMedia, know_depth_and_strength_at_every_point) {
  Worst depth("optical depth at a point, relative error"), strength("strength, relative error");
  Random random(2);
  // A ray in a face is inside or outside, as one likes.
  constexpr test::Kind apart[] = {test::Kind::generic,
                                  test::Kind::into_the_light,
                                  test::Kind::light_behind,
                                  test::Kind::light_along_an_axis,
                                  test::Kind::view_along_an_axis,
                                  test::Kind::light_parallel_to_a_face};
  for (const auto& one : traced(200, apart, 2))
    for (int i = 0; i < 8; ++i) {
      const auto& [all, media, joined, below, section] = *one;
      const double t = random.uniform() * all.ray.t_max;
      // Not within rounding of where something jumps.
      bool near = false;
      for (const double b : all.breaks()) near |= std::abs(b - t) < 1e-9;
      if (near) continue;
      const auto at = section.at(t), alone = section.intersected(t, far_away);
      for (int c = 0; c < 3; ++c) {
        const double d = double(all.depth(t, c)), s = all.strength(t, c);
        depth.see(std::abs(at.depth[c] - d) / (1 + d), all);
        depth.see(std::abs(alone.depth[c] - d) / (1 + d), all);
        strength.see(std::abs(at.strength[c] - s) / (s > 0 ? s : 1), all);
        strength.see(std::abs(alone.strength[c] - s) / (s > 0 ? s : 1), all);
      }
    }
  // Prolonged from its middle, a piece of the ray loses up to the ratio of the two in digits.
  depth.expect_below(1e-13);
  strength.expect_below(1e-14);
}

TEST(JoinedMedia, invert_their_distribution_in_order) {
  Worst worst("distribution of a sample, off u by");
  Random random(3);
  for (const auto& one : traced(120, kinds, 3))
    for (const Channels<double, 3>& chance :
         {Channels<double, 3>{1, 0, 0}, {0, 0, 1}, {0.2, 0.5, 0.3}}) {
      const auto& [all, media, joined, below, section] = *one;
      std::vector<double> us = {0, 0x1p-53, 1e-9, 1 - 1e-9, 1 - 1e-16, 1};
      for (int i = 0; i < 20; ++i) us.push_back(random.uniform());
      std::ranges::sort(us);
      double before = 0;
      for (const double u : us) {
        const double t = section.draw(section.shares(chance), u);
        ASSERT_GE(t, before) << all << " u " << u;
        ASSERT_LE(t, all.ray.t_max) << all << " u " << u;
        before = t;
        const Channels<double, 3> before_t = section.integral_between(0, t);
        double part = 0;
        for (int c = 0; c < 3; ++c) part += chance[c] * before_t[c] / section.integral[c];
        worst.see(std::abs(part - u), all);
      }
    }
  worst.expect_below(5e-14);
}

/// Draws of a placement against the density that it says, and that against quadrature.
template <class Place>
void expect_draws(const Place& place, unsigned seed) {
  std::vector<double> ps;
  for (const auto& one : traced(24, kinds, seed)) {
    const auto& [all, media, joined, below, section] = *one;
    const Channels<double, 3> carried{1, 0.8, 1.3};
    const auto placed = place.on(section, carried);
    std::vector<double> breaks = all.breaks();
    breaks.insert(breaks.end(), section.pieces.t, section.pieces.t + section.pieces.count + 1);
    std::erase_if(breaks, [&](double t) { return !(t > 0 && t < all.ray.t_max); });
    ps.push_back(test::chi_squared_p(
        64, 20'000, [&](double u) { return placed.sample(u); },
        [&](double t) { return placed.pdf(t, section.at(t)); }, 0, all.ray.t_max, breaks, seed++));
    EXPECT_GT(ps.back(), 1e-4) << all;
  }
  const double distance = kolmogorov_smirnov_distance(ps, [](double p) { return p; });
  EXPECT_GT(kolmogorov_smirnov_p(distance, ps.size()), 1e-3);
}

TEST(JoinedMedia, are_sampled_as_every_placement_says) {
  expect_draws(WholeVolume{}, 4);
  expect_draws(Distance{}, 5);
  expect_draws(Equidistant{}, 6);
  expect_draws(Mixed{}, 7);
}

TEST(JoinedMedia, are_drawn_from_in_proportion_to_what_reaches_the_camera) {
  // The whole volume's density in one channel, from the integrand itself.
  unsigned seed = 8;
  for (const auto& one : traced(12, kinds, 8)) {
    const auto& [all, media, joined, below, section] = *one;
    const Exact base = all.least_depth(0);
    const double whole = all.integral(0, base, 0, all.ray.t_max);
    const Channels<double, 3> first{1, 0, 0};
    const double p = test::chi_squared_p(
        64, 20'000, [&](double u) { return section.draw(section.shares(first), u); },
        [&](double t) {
          return all.strength(t, 0) * double(std::exp(base - all.depth(t, 0))) / whole;
        },
        0, all.ray.t_max, all.breaks(), seed++);
    EXPECT_GT(p, 1e-4) << all;
  }
}

TEST(JoinedMedia, scatter_nothing_where_a_ray_only_touches_them) {
  // The ray leaves the second body where it starts, so that the plane of that body's lower face
  // lies in the middle of what is left.
  std::vector<Medium> media(2);
  media[0].shape = Box{{-1, -1, -1}, {0, 1, 1}};
  media[1].shape = Box{{0, -1, -1}, {1, 1, 0}};
  for (Medium& medium : media) medium.sigma_t = medium.sigma_s = Rgb<double>(1.);
  const test::BoxRay ray{{0, 0, 0.5}, normalize(Vec3<double>{-1, 0, -1}), {0, 0, -1}, std::sqrt(2)};
  const Joined one(std::span<const Medium>(media).first(1)), both(media);
  const auto alone = section_of<double, 3>(one, ray, media[0]);
  const auto joined = section_of<double, 3>(both, ray, media[0]);
  EXPECT_NEAR(joined.integral[0] / alone.integral[0], 1, 1e-14);
}

TEST(JoinedMedia, that_touch_and_are_alike_are_one) {
  Worst worst("a box as two halves, relative error of T / (1 + depth)");
  Random random(9);
  const Medium whole = any_medium(random, Cell{}, false);
  std::vector<Medium> halves(2, whole);
  halves[0].shape = Box{{-1, -1, -1}, {0.3, 1, 1}};
  halves[1].shape = Box{{0.3, -1, -1}, {1, 1, 1}};
  const Joined joined(halves);
  const Box::Space space = Box{}.space();
  for (const test::Kind kind : kinds)
    for (int i = 0; i < 40; ++i) {
      const test::BoxRay ray = test::ray_of(kind, random);
      if (!(ray.t_max > 0)) continue;
      const auto in_two = section_of<double, 3>(joined, ray, whole);
      Section<double, 3, Box::Space> in_one(space, {ray.o, ray.d}, ray.w, ray.t_max,
                                            {whole.sigma_t.r, whole.sigma_t.g, whole.sigma_t.b});
      in_one.trace_way_out();
      for (int c = 0; c < 3; ++c) {
        const double strength = whole.sigma_s[c] * evaluate(whole.phase, dot(ray.w, ray.d));
        const double depth = in_one.trapezoids[c].depth;
        worst.see(std::abs(in_two.integral[c] / (strength * in_one.integral[c]) - 1) / (1 + depth),
                  ray);
      }
    }
  worst.expect_below(1e-13);
}

TEST(Stretches, know_the_way_that_a_ray_goes_on_its_own) {
  Worst back("distance at a depth, off by"), glow("emission, relative error");
  Random random(10);
  for (const auto& one : traced(120, kinds, 10)) {
    std::vector<Medium> media = one->media;
    for (Medium& medium : media) medium.emission = {random.uniform(), random.uniform(), 1};
    const auto& ray = one->section.ray;
    auto inside = one->joined.stretches(ray, media[0]);
    inside.media = media.data();
    const auto hull = inside.hull();
    for (int c = 0; c < 3; ++c) {
      const double whole = inside.depth(far_away)[c];
      const double value = whole * random.uniform(0.01, 0.99);
      const auto sigma_of = [c](const Medium& medium) { return medium.sigma_t[c]; };
      const double t = inside.distance_at(value, sigma_of);
      back.see(std::abs(inside.depth(t)[c] - value) / value, one->all);
      EXPECT_GE(inside.distance_at(whole * 1.01, sigma_of), far_away);
      EXPECT_GT(inside.sigma_t(t)[c], 0) << one->all;
      std::vector<double> breaks(inside.enter, inside.enter + inside.count);
      breaks.insert(breaks.end(), inside.leave, inside.leave + inside.count);
      const double from = hull.t_enter + 0.1, to = hull.t_exit - 0.1;
      if (to <= from) continue;
      const double truth = test::integrate(
          from, to,
          [&](double x) {
            double j = 0;
            for (int k = 0; k < inside.count; ++k)
              if (inside.holds(k, x)) j = media[std::size_t(k)].emission[c];
            return j * std::exp(-inside.depth(x)[c]);
          },
          1e-12, breaks);
      glow.see(std::abs(inside.emitted(from, to)[c] - truth) / truth, one->all);
    }
  }
  back.expect_below(1e-13);
  glow.expect_below(1e-11);
}

/// In F against double, both of numbers that F can hold. Every lane has a ray of its own.
template <Real F>
void expect_same(const char* what, double allowed) {
  Worst worst(what);
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    Union all = any_union(random, kinds, false);
    std::vector<Medium> media;
    for (Union::Part& part : all.parts) {
      Box box = std::get<Box>(part.medium.shape);
      box.min = test::narrowed(box.min), box.max = test::narrowed(box.max);
      part.medium.shape = box;
      media.push_back(part.medium);
    }
    const Joined joined(media);
    std::vector<test::BoxRay> rays;
    for (int k = 0; k < lanes<F>; ++k)
      rays.push_back(
          test::in_floats(test::any_ray(random, k % 2 ? test::Kind::generic : random.of(kinds))));
    const auto section = section_of<F, 3>(joined, rays, media[0]);
    for (int k = 0; k < lanes<F>; ++k) {
      // Light that all but follows a face crosses it anywhere, in single precision.
      const Vec3<double>& w = rays[std::size_t(k)].w;
      bool glides = false;
      for (int c = 0; c < 3; ++c) glides |= w[c] != 0 && std::abs(w[c]) < 0.03;
      if (glides) continue;
      const auto truth = section_of<double, 3>(joined, rays[std::size_t(k)], media[0]);
      const auto single = section_of<std::conditional_t<lanes<F> == 1, double, float>, 3>(
          joined, rays[std::size_t(k)], media[0]);
      for (int c = 0; c < 3; ++c) {
        const double found = double(lane(section.integral[c], k));
        double strongest = 0;
        for (const Medium& medium : media)
          strongest =
              std::max(strongest,
                       medium.sigma_s[c] * evaluate(medium.phase, dot(w, rays[std::size_t(k)].d)));
        // Where a ray lies in a face but for rounding, single precision may decide otherwise.
        const double off = std::min(std::abs(found - truth.integral[c]),
                                    std::abs(found - double(single.integral[c])));
        worst.see(off / strongest, all);
      }
    }
  }
  worst.expect_below(allowed);
}

TEST(JoinedMedia, are_the_same_in_every_arithmetic) {
  // Edges that rays pass within rounding of turn up on either side, which moves T by their parts
  // of the ray.
  expect_same<float>("T of a union in float, off by parts of the longest mean [m]", 1e-5);
  expect_same<FloatBatch>("T of a union in lanes, off by parts of the longest mean [m]", 1e-5);
}

TEST(JoinedMedia, say_what_fits_and_leave_out_what_does_not) {
  const auto row_of = [](int count, const Shapes& one) {
    std::vector<Medium> media(std::size_t(count), Medium{});
    for (Medium& medium : media) medium.shape = one;
    return media;
  };
  Convex prism;
  prism.face_count = 20;
  EXPECT_TRUE(Joined::fits({}));
  EXPECT_TRUE(Joined::fits(row_of(16, Box{})));
  EXPECT_FALSE(Joined::fits(row_of(17, Box{})));
  EXPECT_TRUE(Joined::fits(row_of(4, prism)));
  EXPECT_FALSE(Joined::fits(row_of(5, prism)));
  EXPECT_FALSE(Joined::fits(row_of(2, Unbounded{})));

  const std::vector<Medium> many = row_of(40, Box{});
  const Joined joined(many);
  const LocalRay<double> ray{{0, 0, -3}, {0, 0, 1}};
  EXPECT_EQ(joined.stretches(ray, many[0]).length_before(15, 9.), 2);
  EXPECT_EQ(joined.clip(ray).t_exit, 4);
}

TEST(JoinedMedia, have_room_for_sixteen_boxes) {
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    std::vector<Medium> media;
    for (const Cell& cell : cells(random, Joined::most_parts))
      media.push_back(any_medium(random, cell, false));
    const Joined joined(media);
    test::BoxRay ray = test::ray_of(random.of(kinds), random);
    ray.t_max = 4;
    const auto section = section_of<FloatBatch, 3>(joined, ray, media[0]);
    EXPECT_LE(section.pieces.count, Joined::most_pieces);
    EXPECT_GE(lane(section.integral[0], 0), 0);
  }
}

}  // namespace
}  // namespace airlight
