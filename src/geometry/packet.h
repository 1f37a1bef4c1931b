#pragma once
#include <airlight/math/vec.h>
#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstring>

namespace airlight {

/// Embree's structures and calls for `lanes` rays at once.
template <int lanes>
struct PacketCalls;

template <>
struct PacketCalls<1> {
  using Ray = RTCRay;
  using RayHit = RTCRayHit;
  static void occluded(const int*, RTCScene scene, RTCIntersectContext* context, Ray* ray) {
    rtcOccluded1(scene, context, ray);
  }
  static void intersect(const int*, RTCScene scene, RTCIntersectContext* context, RayHit* ray) {
    rtcIntersect1(scene, context, ray);
  }
};
template <>
struct PacketCalls<4> {
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
  static constexpr auto occluded = rtcOccluded4;
  static constexpr auto intersect = rtcIntersect4;
};
template <>
struct PacketCalls<8> {
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
  static constexpr auto occluded = rtcOccluded8;
  static constexpr auto intersect = rtcIntersect8;
};
template <>
struct PacketCalls<16> {
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
  static constexpr auto occluded = rtcOccluded16;
  static constexpr auto intersect = rtcIntersect16;
};

/// The first lane's place in a member of a packet, be it of one ray or of many.
template <class T>
T* first_lane(T& member) noexcept {
  return &member;
}
template <class T, std::size_t n>
T* first_lane(T (&member)[n]) noexcept {
  return member;
}

/// What happened to the light of a ray so far, on its way through surfaces that are not opaque.
struct Passage {
  float red, green, blue;  ///< the product over the surfaces crossed
  unsigned crossings;      ///< their number
  /// The last crossings in a ring: of which object, and where.
  std::array<std::uint32_t, 4> object;
  std::array<float, 4> t;

  void start() noexcept {
    red = green = blue = 1;
    crossings = 0;
  }

  /// Notes a crossing, unless Embree told of it before: it gives a ray that meets a shared edge to
  /// both triangles, shortly after one another. Returns whether it is a new one.
  bool cross(std::uint32_t crossed, float at) noexcept {
    for (unsigned i = 0; i < crossings && i < object.size(); ++i)
      if (object[i] == crossed && std::abs(t[i] - at) <= 4e-7f * at) return false;
    object[crossings % object.size()] = crossed;
    t[crossings % object.size()] = at;
    ++crossings;
    return true;
  }
};

/// How the rays of a packet lie to one another.
enum class Bundle {
  loose,  ///< anyhow
  tight,  ///< side by side, as those of neighbouring pixels: Embree follows them as one frustum
};

/// What goes with a packet through Embree to the filters of surfaces that are not opaque. Embree's
/// part comes first: filters are handed a pointer to it.
struct PacketContext {
  RTCIntersectContext embree;
  std::array<Passage, 16> passages;  ///< by ray id

  explicit PacketContext(Bundle bundle) noexcept {
    rtcInitIntersectContext(&embree);
    embree.flags = bundle == Bundle::tight ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                           : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
};

/// Fills in a packet but for the hits.
template <Real F, class Ray>
void set_rays(Ray& ray, Vec3<F> origin, Vec3<F> direction, F t_min, F t_max) noexcept {
  static constexpr std::array<std::uint32_t, 16> ids{0, 1, 2,  3,  4,  5,  6,  7,
                                                     8, 9, 10, 11, 12, 13, 14, 15};
  store(origin.x, first_lane(ray.org_x));
  store(origin.y, first_lane(ray.org_y));
  store(origin.z, first_lane(ray.org_z));
  store(t_min, first_lane(ray.tnear));
  store(direction.x, first_lane(ray.dir_x));
  store(direction.y, first_lane(ray.dir_y));
  store(direction.z, first_lane(ray.dir_z));
  store(F(0), first_lane(ray.time));
  store(t_max, first_lane(ray.tfar));
  std::memset(&ray.mask, 0xff, sizeof ray.mask);
  std::memcpy(&ray.id, ids.data(), sizeof ray.id);
  std::memset(&ray.flags, 0, sizeof ray.flags);
}

}  // namespace airlight
