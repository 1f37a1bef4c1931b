#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "bounds.h"
#include "packet.h"
#include "scene/scene.h"
#include "surface_filter.h"

namespace airlight {

/// Where rays meet the scene first, a ray a lane.
template <Real F>
struct Hit {
  F t;            ///< in units of the direction's length; far_away where nothing was found
  Mask<F> found;  ///< what follows counts only there
  std::array<std::uint32_t, lanes<F>> object;     ///< index into Scene::objects
  std::array<std::uint32_t, lanes<F>> primitive;  ///< triangle of the mesh
  std::array<float, lanes<F>> u, v;               ///< the point on it, for `World::surface`
};

/// What a surface is like at a point.
struct SurfacePoint {
  Vec3<float> normal;            ///< unit, interpolated as the mesh says, on an arbitrary side
  Vec3<float> geometric_normal;  ///< unit, of the triangle itself, on an arbitrary side
  Rgb<float> albedo;             ///< diffuse
  float opacity;                 ///< in [0, 1]
  Rgb<float> transmittance;      ///< (1 − opacity) · tint
  std::uint32_t object;          ///< index into Scene::objects
};

/// What a kernel may ask of the scene's surfaces. Any thread may ask at any time.
///
/// Visibility is Embree's, in single precision, watertight where triangles share edges. Rays do not
/// know the surface they start on: a ray that leaves one starts a little above it.
class World {
 public:
  /// Builds what answers the rays. The scene must outlive the World and must not change: meshes are
  /// shared with it. Throws Error if memory does not suffice.
  World(const Scene& scene, Visibility visibility);

  /// What light is multiplied by on the way from `from` to `from + t_max dir`: the product of (1 −
  /// opacity) · tint over the surfaces it crosses; 1 is free, 0 blocked. 0 in lanes that are not
  /// active. All lights see the same surfaces, so far: `light` (index into Scene::lights) does not
  /// matter.
  template <Real F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> dir, F t_max, int light, Mask<F> active) const noexcept;

  /// The nearest surface beyond t_min that does something to light. Not found in lanes that are not
  /// active.
  template <Real F>
  Hit<F> closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active) const noexcept;

  /// The surface at a hit's point.
  SurfacePoint surface(std::uint32_t object, std::uint32_t primitive, float u,
                       float v) const noexcept;

  /// Whether any surface lets light through.
  bool filters() const noexcept { return filters_; }

  /// Around all objects.
  const Bounds& bounds() const noexcept { return bounds_; }

 private:
  struct Release {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  /// Names the point of a sphere by its normal; leaves points of meshes as they are. Called from
  /// objects of every instruction set, so its signature has none of the core's types, whose names
  /// differ between them.
  void locate_on_sphere(std::uint32_t object, const std::array<float, 3>& normal, float& u,
                        float& v) const noexcept;
  void attach(std::uint32_t id);

  const Scene* scene_;
  Bounds bounds_;
  std::vector<SurfaceFilter> surfaces_;  ///< one an object; Embree keeps pointers to them
  bool filters_ = false;
  bool has_spheres_ = false;
  Owned<RTCDevice> device_;
  Owned<RTCScene> embree_;
};

template <Real F>
Rgb<F> World::transmit(Vec3<F> from, Vec3<F> dir, F t_max, int, Mask<F> active) const noexcept {
  using Calls = PacketCalls<lanes<F>>;
  alignas(64) std::int32_t valid[lanes<F>];
  store_mask<F>(active, valid);
  typename Calls::Ray ray;
  set_rays(ray, from, dir, F(0), t_max);

  PacketContext context;
  if (filters_) {
    context.red.fill(1);
    context.green.fill(1);
    context.blue.fill(1);
  }
  if constexpr (lanes<F> == 1) {
    if (!active) return {};
  }
  Calls::occluded(valid, embree_.get(), &context.embree, &ray);

  // Embree marks what is blocked by a negative end.
  const Mask<F> free = active && load<F>(first_lane(ray.tfar)) >= F(0);
  const F zero(0), one(1);
  if (!filters_) return Rgb<F>(select(free, one, zero));
  return {select(free, load<F>(context.red.data()), zero),
          select(free, load<F>(context.green.data()), zero),
          select(free, load<F>(context.blue.data()), zero)};
}

template <Real F>
Hit<F> World::closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active) const noexcept {
  using Calls = PacketCalls<lanes<F>>;
  alignas(64) std::int32_t valid[lanes<F>];
  store_mask<F>(active, valid);
  typename Calls::RayHit ray;
  set_rays(ray.ray, origin, dir, t_min, F(far_away));
  std::memset(&ray.hit.geomID, 0xff, sizeof ray.hit.geomID);
  std::memset(&ray.hit.instID, 0xff, sizeof ray.hit.instID);

  PacketContext context;
  const bool asked = lanes<F> > 1 || bits<F>(active) != 0;
  if (asked) Calls::intersect(valid, embree_.get(), &context.embree, &ray);

  Hit<F> hit;
  std::memcpy(hit.object.data(), &ray.hit.geomID, sizeof hit.object);
  std::memcpy(hit.primitive.data(), &ray.hit.primID, sizeof hit.primitive);
  std::memcpy(hit.u.data(), &ray.hit.u, sizeof hit.u);
  std::memcpy(hit.v.data(), &ray.hit.v, sizeof hit.v);
  std::uint32_t found = 0;
  for (int i = 0; i < lanes<F>; ++i)
    found |= std::uint32_t(hit.object[std::size_t(i)] != RTC_INVALID_GEOMETRY_ID) << i;
  hit.found = active && mask_from_bits<F>(found);
  hit.t = select(hit.found, load<F>(first_lane(ray.ray.tfar)), F(far_away));

  if (has_spheres_) {
    for (int i = 0; i < lanes<F>; ++i) {
      if ((found >> i & 1) == 0) continue;
      const std::size_t n = std::size_t(i);
      locate_on_sphere(
          hit.object[n],
          {first_lane(ray.hit.Ng_x)[i], first_lane(ray.hit.Ng_y)[i], first_lane(ray.hit.Ng_z)[i]},
          hit.u[n], hit.v[n]);
    }
  }
  return hit;
}

}  // namespace airlight
