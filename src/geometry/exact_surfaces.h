#pragma once
#include <airlight/math/vec.h>

#include <span>
#include <vector>

#include "geometry/among.h"
#include "geometry/hit.h"
#include "geometry/surface_filter.h"

namespace airlight {

struct Scene;

/// Every sphere and every triangle of a scene, asked in turn in the ray's own arithmetic: slow, and
/// in double exact enough to be held against closed forms. Triangles that share an edge share out
/// the rays that go through it: just one of them has each. (About a ray that meets a corner to the
/// last bit they may disagree.)
class ExactSurfaces {
 public:
  ExactSurfaces(const Scene& scene, Among among);

  /// As World::transmit; `surfaces` are the objects'.
  template <Real F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> dir, F t_max, Mask<F> active,
                  std::span<const SurfaceFilter> surfaces) const noexcept;

  /// As World::closest; `surfaces` are the objects'.
  template <Real F>
  Hit<F> closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                 std::span<const SurfaceFilter> surfaces) const noexcept;

 private:
  struct Ball {
    Vec3<double> centre;
    double radius;
    std::uint32_t object;
  };

  struct Triangle {
    Vec3<double> corners[3];
    Vec3<double> normal;  ///< (b − a) × (c − a)
    bool ascending[3];    ///< whether the edge from this corner to the next goes up in the order of
                          ///< coordinates
    std::uint32_t object, primitive;
  };

  /// Where rays cross a surface.
  template <Real F>
  struct Crossing {
    Mask<F> inside;  ///< the surface's outline
    F t;
    std::uint32_t object;
    std::uint32_t primitive = 0;
    bool on_sphere = false;
    Vec3<F> normal{};      ///< of a sphere
    F u = F(0), v = F(0);  ///< on a triangle

    /// Where on the object, as Embree and SurfaceFilter say it.
    std::array<float, 2> point(int i) const noexcept {
      if (!on_sphere) return {float(lane(u, i)), float(lane(v, i))};
      return sphere_point(float(lane(normal.x, i)), float(lane(normal.y, i)),
                          float(lane(normal.z, i)));
    }
  };

  template <Real F>
  static Crossing<F> crossing(const Triangle& triangle, Vec3<F> origin, Vec3<F> dir) noexcept;

  /// Calls visit(crossing) for every surface, whether or not a ray crosses it.
  template <Real F, class Visit>
  void for_each_crossing(Vec3<F> origin, Vec3<F> dir, Visit&& visit) const noexcept;

  std::vector<Ball> balls_;
  std::vector<Triangle> triangles_;
};

template <Real F>
ExactSurfaces::Crossing<F> ExactSurfaces::crossing(const Triangle& triangle, Vec3<F> origin,
                                                   Vec3<F> dir) noexcept {
  const Vec3<F> p[3] = {Vec3<F>(triangle.corners[0]) - origin,
                        Vec3<F>(triangle.corners[1]) - origin,
                        Vec3<F>(triangle.corners[2]) - origin};
  // On which side of each edge the ray passes. An edge is always taken from its lower to its upper
  // end, so that neighbours find the same number, and zero counts as positive for that direction.
  F side[3];
  Mask<F> left[3];
  for (int i = 0; i < 3; ++i) {
    const bool up = triangle.ascending[i];
    const Vec3<F> low = up ? p[i] : p[(i + 1) % 3], high = up ? p[(i + 1) % 3] : p[i];
    const F s = dot(dir, cross(low, high));
    side[i] = up ? s : -s;
    left[i] = up ? s >= F(0) : s < F(0);
  }
  const Vec3<F> normal(triangle.normal);
  const F scale = F(1) / (side[0] + side[1] + side[2]);
  Crossing<F> result{};
  result.inside = (left[0] && left[1] && left[2]) || !(left[0] || left[1] || left[2]);
  result.t = dot(normal, p[0]) / dot(normal, dir);
  result.object = triangle.object;
  result.primitive = triangle.primitive;
  result.u = side[2] * scale;
  result.v = side[0] * scale;
  return result;
}

template <Real F, class Visit>
void ExactSurfaces::for_each_crossing(Vec3<F> origin, Vec3<F> dir, Visit&& visit) const noexcept {
  const F length2 = dot(dir, dir);
  for (const Ball& ball : balls_) {
    const Vec3<F> from_centre = origin - Vec3<F>(ball.centre);
    const F middle = -dot(from_centre, dir) / length2;
    const Vec3<F> off = from_centre + dir * middle;
    const F half2 = F(Scalar<F>(ball.radius * ball.radius)) - dot(off, off);
    const F half = sqrt(max(half2, F(0)) / length2);
    for (const F t : {middle - half, middle + half}) {
      Crossing<F> result{};
      result.inside = half2 > F(0);
      result.t = t;
      result.object = ball.object;
      result.on_sphere = true;
      result.normal = from_centre + dir * t;
      visit(result);
    }
  }
  for (const Triangle& triangle : triangles_) visit(crossing(triangle, origin, dir));
}

template <Real F>
Rgb<F> ExactSurfaces::transmit(Vec3<F> from, Vec3<F> dir, F t_max, Mask<F> active,
                               std::span<const SurfaceFilter> surfaces) const noexcept {
  Rgb<F> product(F(1));
  Mask<F> free = active;
  for_each_crossing(from, dir, [&](const Crossing<F>& at) {
    const Mask<F> crossed = free && at.inside && at.t > F(0) && at.t < t_max;
    if (!any(crossed)) return;
    const SurfaceFilter& surface = surfaces[at.object];
    if (surface.is_opaque()) {
      free = free && !crossed;
    } else if (!surface.varies()) {
      product *= select<F>(crossed, Rgb<F>(surface.transmittance()), Rgb<F>(F(1)));
    } else {
      const std::uint32_t which = bits<F>(crossed);
      Scalar<F> factor[3][lanes<F>];
      for (int i = 0; i < lanes<F>; ++i) {
        Rgb<float> here(1.f);
        if (which >> i & 1) {
          const auto [u, v] = at.point(i);
          here = surface.transmittance(at.primitive, u, v);
        }
        for (int c = 0; c < 3; ++c) factor[c][i] = here[c];
      }
      product *= Rgb<F>(load<F>(factor[0]), load<F>(factor[1]), load<F>(factor[2]));
    }
  });
  return select<F>(free, product, Rgb<F>(F(0)));
}

template <Real F>
Hit<F> ExactSurfaces::closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                              std::span<const SurfaceFilter> surfaces) const noexcept {
  Hit<F> hit = Hit<F>::none();
  for_each_crossing(origin, dir, [&](const Crossing<F>& at) {
    const SurfaceFilter& surface = surfaces[at.object];
    if (surface.is_clear()) return;
    const Mask<F> nearer = active && at.inside && at.t > t_min && at.t < hit.t;
    std::uint32_t which = bits<F>(nearer);
    for (int i = 0; i < lanes<F>; ++i) {
      if ((which >> i & 1) == 0) continue;
      const auto [u, v] = at.point(i);
      if (surface.varies() && surface.is_clear(at.primitive, u, v)) {
        which &= ~(1u << i);
        continue;
      }
      const std::size_t n = std::size_t(i);
      hit.object[n] = at.object;
      hit.primitive[n] = at.primitive;
      hit.u[n] = u;
      hit.v[n] = v;
    }
    hit.t = select(mask_from_bits<F>(which), at.t, hit.t);
  });
  hit.found = active && hit.t < F(Scalar<F>(far_away));
  return hit;
}

}  // namespace airlight
