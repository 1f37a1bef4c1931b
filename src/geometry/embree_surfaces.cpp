#include "geometry/embree_surfaces.h"

#include <fmt/format.h>

#include "error.h"
#include "scene/scene.h"

namespace airlight {

namespace {

/// Where on its object Embree met a surface.
struct Point {
  std::uint32_t primitive;
  float u, v;
};

Point point_of(const SurfaceFilter& surface, RTCHitN* hit, unsigned n, unsigned i) noexcept {
  const std::uint32_t primitive = RTCHitN_primID(hit, n, i);
  if (!surface.on_sphere()) return {primitive, RTCHitN_u(hit, n, i), RTCHitN_v(hit, n, i)};
  const auto [u, v] =
      sphere_point(RTCHitN_Ng_x(hit, n, i), RTCHitN_Ng_y(hit, n, i), RTCHitN_Ng_z(hit, n, i));
  return {primitive, u, v};
}

/// Embree asks here what becomes of shadow rays that meet a surface that is not opaque: their light
/// is multiplied by a factor, and they go on unless nothing is left of it.
void filter_shadow(const RTCFilterFunctionNArguments* call) {
  const auto& surface = *static_cast<const SurfaceFilter*>(call->geometryUserPtr);
  auto& context = *reinterpret_cast<PacketContext*>(call->context);
  for (unsigned i = 0; i < call->N; ++i) {
    if (call->valid[i] != -1) continue;
    Passage& passage = context.passages[RTCRayN_id(call->ray, call->N, i)];
    if (passage.cross(RTCHitN_geomID(call->hit, call->N, i), RTCRayN_tfar(call->ray, call->N, i))) {
      const auto [primitive, u, v] = point_of(surface, call->hit, call->N, i);
      const Rgb<float> factor = surface.transmittance(primitive, u, v);
      passage.red *= factor.r;
      passage.green *= factor.g;
      passage.blue *= factor.b;
    }
    if (passage.red > 0 || passage.green > 0 || passage.blue > 0) call->valid[i] = 0;
  }
}

/// The same for rays that look for the closest surface: what does nothing to light is not seen.
void filter_hit(const RTCFilterFunctionNArguments* call) {
  const auto& surface = *static_cast<const SurfaceFilter*>(call->geometryUserPtr);
  for (unsigned i = 0; i < call->N; ++i) {
    if (call->valid[i] != -1) continue;
    const auto [primitive, u, v] = point_of(surface, call->hit, call->N, i);
    if (surface.is_clear(primitive, u, v)) call->valid[i] = 0;
  }
}

}  // namespace

EmbreeSurfaces::EmbreeSurfaces(const Scene& scene, std::span<const SurfaceFilter> surfaces,
                               Among among)
    : scene_(&scene), device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) throw Error("Embree does not start on this machine; it needs SSE2");
  embree_.reset(rtcNewScene(device_.get()));
  // Without the flag, 8 % of the rays that are aimed at a shared edge leak through it; it costs 10
  // to 18 % of the rays a second. Medium quality builds without splitting triangles, so that a
  // filter meets each of them once.
  rtcSetSceneFlags(embree_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree_.get(), RTC_BUILD_QUALITY_MEDIUM);
  for (std::uint32_t id = 0; id < scene.objects.size(); ++id)
    if (!surfaces[id].is_clear() && (among == Among::all || scene.objects[id].holdout))
      attach(id, surfaces[id]);
  rtcCommitScene(embree_.get());
  switch (const RTCError error = rtcGetDeviceError(device_.get())) {
    case RTC_ERROR_NONE:
      break;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw Error("the scene's surfaces are too many for this machine's memory");
    default:
      throw Error(
          fmt::format("Embree does not take the scene's surfaces (its error {})", int(error)));
  }
}

void EmbreeSurfaces::attach(std::uint32_t id, const SurfaceFilter& surface) {
  const Object& object = scene_->objects[id];
  const auto* mesh = std::get_if<Mesh>(&object.geometry);
  if (mesh != nullptr && mesh->triangles.empty()) return;

  const RTCGeometry geometry = rtcNewGeometry(
      device_.get(), mesh != nullptr ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  if (mesh != nullptr) {
    using Position = decltype(mesh->positions)::value_type;
    using Triangle = decltype(mesh->triangles)::value_type;
    const auto& positions = mesh->positions;
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions.data(), 0, sizeof(Position), positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh->triangles.data(), 0, sizeof(Triangle), mesh->triangles.size());
  } else {
    const auto& [centre, radius] = std::get<Sphere>(object.geometry);
    const std::array<float, 4> sphere{float(centre.x), float(centre.y), float(centre.z),
                                      float(radius)};
    if (void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                             sizeof sphere, 1))
      std::memcpy(copy, sphere.data(), sizeof sphere);
  }
  has_spheres_ = has_spheres_ || mesh == nullptr;
  if (!surface.is_opaque()) {
    has_filters_ = true;
    rtcSetGeometryUserData(geometry, const_cast<SurfaceFilter*>(&surface));
    rtcSetGeometryOccludedFilterFunction(geometry, filter_shadow);
    rtcSetGeometryIntersectFilterFunction(geometry, filter_hit);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_.get(), geometry, id);
  rtcReleaseGeometry(geometry);
}

bool EmbreeSurfaces::is_sphere(std::uint32_t object) const noexcept {
  return std::holds_alternative<Sphere>(scene_->objects[object].geometry);
}

}  // namespace airlight
