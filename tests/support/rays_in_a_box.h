#pragma once
#include <airlight/math/vec.h>

#include <array>
#include <cmath>
#include <ostream>
#include <vector>

#include "exact_way.h"
#include "random.h"

namespace airlight::test {

/// A camera ray in the box [-1, 1]^3 and where light comes from.
struct BoxRay {
  Vec3<double> o, d, w;
  double t_max = 0;

  friend std::ostream& operator<<(std::ostream& out, const BoxRay& ray) {
    const auto put = [&](const char* name, const Vec3<double>& v) {
      out << name << " {" << v.x << ", " << v.y << ", " << v.z << "} ";
    };
    put("o", ray.o), put("d", ray.d), put("w", ray.w);
    return out << "t_max " << ray.t_max;
  }
};

/// Numbers as a float holds them.
inline double narrowed(double x) {
  const volatile float narrower = float(x);  // gcc 12 forgets the way there and back if it may
  return double(narrower);
}
inline Vec3<double> narrowed(const Vec3<double>& v) {
  return {narrowed(v.x), narrowed(v.y), narrowed(v.z)};
}

inline Point point(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

/// The ray as floats hold it, ending where it leaves the body if not before.
inline BoxRay narrowed(const BoxRay& ray, const Body& body = box_body()) {
  BoxRay narrow = {narrowed(ray.o), narrowed(ray.d), narrowed(ray.w), 0};
  const Exact exit = exact_distance_out(body, point(narrow.o), point(narrow.d));
  narrow.t_max = narrowed(std::min(ray.t_max, double(exit) * (1 - 0x1p-23)));
  return narrow;
}

inline ExactWay exact(const BoxRay& ray, Exact parallel_below = 0) {
  return {box_body(), point(ray.o), point(ray.d), point(ray.w), ray.t_max, parallel_below};
}

/// What can be special about a ray, a light and a box.
enum class Kind {
  generic,
  into_the_light,         // w = d
  light_behind,           // w = -d
  nearly_into_the_light,  // w = d + 1e-6
  barely_off_the_light,   // w = d + 1e-9
  light_nearly_behind,    // w = -d + 1e-6
  light_along_an_axis,
  view_along_an_axis,
  both_along_axes,
  light_parallel_to_a_face,
  view_parallel_to_a_face,
  both_parallel_to_faces,
  gliding_in_a_face,
  from_a_corner,
  tied,  // two or three faces met at once
  from_outside,
  level,  // the length of the way stays the same along some of the ray
};
inline constexpr int kinds = int(Kind::level) + 1;

inline BoxRay ray_of(Kind kind, Random& random) {
  const auto axis = [&] {
    Vec3<double> v;
    (random.below(3) == 0 ? v.x : random.below(2) == 0 ? v.y : v.z) = random.sign();
    return v;
  };
  const auto component = [](Vec3<double>& v, int k) -> double& {
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
  };
  const auto in_a_plane = [&] {
    Vec3<double> v = random.direction();
    component(v, random.below(3)) = 0;
    return normalize(v);
  };
  const auto diagonal = [&] {
    return Vec3<double>(random.sign(), random.sign(), random.sign()) * (1 / std::sqrt(3.));
  };
  BoxRay ray{random.in_the_cube(), random.direction(), random.direction()};
  switch (kind) {
    case Kind::generic:
      break;
    case Kind::into_the_light:
      ray.w = ray.d;
      break;
    case Kind::light_behind:
      ray.w = -ray.d;
      break;
    case Kind::nearly_into_the_light:
      ray.w = normalize(ray.d + random.in_the_cube() * 1e-6);
      break;
    case Kind::barely_off_the_light:
      ray.w = normalize(ray.d + random.in_the_cube() * 1e-9);
      break;
    case Kind::light_nearly_behind:
      ray.w = normalize(random.in_the_cube() * 1e-6 - ray.d);
      break;
    case Kind::light_along_an_axis:
      ray.w = axis();
      break;
    case Kind::view_along_an_axis:
      ray.d = axis();
      break;
    case Kind::both_along_axes:
      ray.w = axis(), ray.d = axis();
      break;
    case Kind::light_parallel_to_a_face:
      ray.w = in_a_plane();
      break;
    case Kind::view_parallel_to_a_face:
      ray.d = in_a_plane();
      break;
    case Kind::both_parallel_to_faces:
      ray.w = in_a_plane(), ray.d = in_a_plane();
      break;
    case Kind::gliding_in_a_face: {
      const int k = random.below(3);
      component(ray.o, k) = random.sign();
      component(ray.d, k) = 0;
      ray.d = normalize(ray.d);
      break;
    }
    case Kind::from_a_corner:
      ray.o = {random.sign(), random.sign(), random.sign()};
      for (int k = 0; k < 3; ++k) component(ray.d, k) = std::copysign(ray.d[k], -ray.o[k]);
      break;
    case Kind::tied:
      ray.o = random.below(2) == 0 ? Vec3<double>() : diagonal() * random.uniform();
      ray.w = diagonal();
      if (random.below(2) == 0) ray.d = diagonal();
      break;
    case Kind::from_outside:
      do {
        ray.o = random.direction() * random.uniform(2, 6);
        ray.d = normalize(random.in_the_cube() - ray.o);
      } while (std::abs(ray.d.x) < 1e-3 || std::abs(ray.d.y) < 1e-3 || std::abs(ray.d.z) < 1e-3);
      break;
    case Kind::level: {
      ray.w = ray.d;
      const int k = random.below(3);
      component(ray.w, k) = -ray.d[k];
      break;
    }
  }
  Exact enter = 0;
  for (const HalfSpace& face : box_body())
    if (const Exact facing = dot(face.n, point(ray.d)); facing < 0)
      enter = std::max(enter, (face.h - dot(face.n, point(ray.o))) / facing);
  ray.o = ray.o + ray.d * double(enter);
  ray.t_max = double(exact_distance_out(box_body(), point(ray.o), point(ray.d)));
  if (random.below(2) == 0) ray.t_max *= random.uniform();  // a surface before the exit
  return ray;
}

/// `n` rays of every kind. `least` bounds the components of w from below, where they are not zero:
/// the distance out through a face nearly parallel to the light is ill-conditioned.
inline std::vector<BoxRay> rays_of_every_kind(int n, double least, unsigned seed) {
  Random random(seed);
  std::vector<BoxRay> rays;
  for (int kind = 0; kind < kinds; ++kind)
    for (int i = 0; i < n;) {
      const BoxRay ray = ray_of(Kind(kind), random);
      const auto fine = [&](double w) { return w == 0 || std::abs(w) > least; };
      if (!fine(ray.w.x) || !fine(ray.w.y) || !fine(ray.w.z)) continue;
      rays.push_back(ray);
      ++i;
    }
  return rays;
}

/// 0 or spread evenly over the orders of magnitude from 1e-3 to 1e4.  [1/m]
inline double any_sigma(Random& random) {
  return random.below(16) == 0 ? 0 : random.log_uniform(1e-3, 1e4);
}

}  // namespace airlight::test
