#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "geometry/among.h"
#include "geometry/hit.h"
#include "geometry/packet.h"
#include "geometry/surface_filter.h"

namespace airlight {

struct Scene;

/// A scene's surfaces in Embree: rays in packets of the arithmetic's lanes, in single precision,
/// watertight where triangles share edges. An object's geometry has the object's index as its id.
class EmbreeSurfaces {
 public:
  /// Scene and surfaces must outlive it and stay where they are: meshes are shared with the scene,
  /// and filters look at the surfaces. Throws Error if memory does not suffice.
  EmbreeSurfaces(const Scene& scene, std::span<const SurfaceFilter> surfaces, Among among);

  /// As World::transmit.
  template <Real F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> dir, F t_max, Mask<F> active, Bundle bundle) const noexcept;

  /// As World::closest.
  template <Real F>
  Hit<F> closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                 Bundle bundle) const noexcept;

  /// What Embree's own functions take.
  RTCScene handle() const noexcept { return embree_.get(); }

 private:
  struct Release {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  void attach(std::uint32_t id, const SurfaceFilter& surface);

  bool is_sphere(std::uint32_t object) const noexcept;

  const Scene* scene_;
  bool has_filters_ = false;
  bool has_spheres_ = false;
  Owned<RTCDevice> device_;
  Owned<RTCScene> embree_;
};

template <Real F>
Rgb<F> EmbreeSurfaces::transmit(Vec3<F> from, Vec3<F> dir, F t_max, Mask<F> active,
                                Bundle bundle) const noexcept {
  using Calls = PacketCalls<lanes<F>>;
  PacketContext context(bundle);
  if (has_filters_)
    for (int i = 0; i < lanes<F>; ++i) context.passages[std::size_t(i)].start();
  alignas(64) std::int32_t valid[lanes<F>];
  store_mask<F>(active, valid);
  typename Calls::Ray ray;
  set_rays(ray, from, dir, F(0), t_max);
  Calls::occluded(valid, embree_.get(), &context.embree, &ray);

  // Embree marks what is blocked by a negative end.
  const Mask<F> free = active && load<F>(first_lane(ray.tfar)) >= F(0);
  if (!has_filters_) return Rgb<F>(select(free, F(1), F(0)));
  Scalar<F> passed[3][lanes<F>];
  for (int i = 0; i < lanes<F>; ++i) {
    const Passage& passage = context.passages[std::size_t(i)];
    passed[0][i] = passage.red;
    passed[1][i] = passage.green;
    passed[2][i] = passage.blue;
  }
  const Rgb<F> product(load<F>(passed[0]), load<F>(passed[1]), load<F>(passed[2]));
  return select<F>(free, product, Rgb<F>());
}

template <Real F>
Hit<F> EmbreeSurfaces::closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                               Bundle bundle) const noexcept {
  using Calls = PacketCalls<lanes<F>>;
  PacketContext context(bundle);
  alignas(64) std::int32_t valid[lanes<F>];
  store_mask<F>(active, valid);
  typename Calls::RayHit packet;
  // Embree finds what lies at t_min too; a few roundings further, a ray that goes on from one
  // surface to the next doesn't meet the same one again.
  const F beyond = t_min + max(t_min * F(5e-7f), F(1e-30f));
  set_rays(packet.ray, origin, dir, beyond, F(Scalar<F>(far_away)));
  std::memset(&packet.hit, 0xff, sizeof packet.hit);  // nothing found yet
  Calls::intersect(valid, embree_.get(), &context.embree, &packet);

  Hit<F> hit;
  std::memcpy(hit.object.data(), &packet.hit.geomID, sizeof hit.object);
  std::memcpy(hit.primitive.data(), &packet.hit.primID, sizeof hit.primitive);
  std::memcpy(hit.u.data(), &packet.hit.u, sizeof hit.u);
  std::memcpy(hit.v.data(), &packet.hit.v, sizeof hit.v);
  const F t = load<F>(first_lane(packet.ray.tfar));
  hit.found = active && t < F(float(far_away));
  hit.t = select(hit.found, t, F(Scalar<F>(far_away)));
  if (has_spheres_) {
    // All that Embree says of a point on a sphere is the normal.
    for (int i = 0; i < lanes<F>; ++i) {
      const std::size_t n = std::size_t(i);
      if (hit.object[n] == Hit<F>::nothing || !is_sphere(hit.object[n])) continue;
      const auto [u, v] =
          sphere_point(first_lane(packet.hit.Ng_x)[i], first_lane(packet.hit.Ng_y)[i],
                       first_lane(packet.hit.Ng_z)[i]);
      hit.u[n] = u;
      hit.v[n] = v;
    }
  }
  return hit;
}

}  // namespace airlight
