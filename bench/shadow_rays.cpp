#include "shadow_rays.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "geometry/flush_to_zero.h"
#include "geometry/world.h"
#include "measure.h"
#include "render/prepare.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// Shadow rays as the kernels ask for them, written down on the way to the real world.
struct Recorder {
  const World& world;
  mutable std::vector<std::array<float, 6>> rays;

  Rgb<float> transmit(Vec3<float> from, Vec3<float> to, float, int, bool active) const {
    if (active)
      rays.push_back({from.x, from.y, from.z, to.x, to.y, to.z});
    else
      rays.push_back({0, 0, 0, 0, 0, 0});
    return Rgb<float>(1.f);
  }
};

template <int width>
struct Packets;
template <>
struct Packets<8> {
  using Ray = RTCRay8;
  static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Ray* ray) {
    rtcOccluded8(valid, scene, context, ray);
  }
};
template <>
struct Packets<16> {
  using Ray = RTCRay16;
  static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, Ray* ray) {
    rtcOccluded16(valid, scene, context, ray);
  }
};

/// The in-scatter shadow rays of a picture with one ray through each pixel's centre, in the packets
/// of a kernel of this width: a block of pixels, the same sample in each.
template <int width>
struct PictureOfRays {
  struct alignas(64) Packet {
    typename Packets<width>::Ray ray;
    alignas(64) int valid[width];
  };
  std::vector<Packet> packets;
  std::size_t count = 0;

  PictureOfRays(const Scene& scene, const World& world, const RenderSettings& settings) {
    const Prepared prepared = prepare(scene, world, settings);
    const Medium& medium = *scene.medium;
    const auto& space = std::get<Box>(medium.shape).space();
    const auto& sampled = std::get<Sampled>(prepared.frame.estimator);
    const auto& sun = std::get<Directional>(scene.lights.at(0));
    const CameraFrame& camera = prepared.frame.camera;
    constexpr int block_height = width >= 16 ? 4 : 2, block_width = width / block_height;
    const int spp = int(settings.spp);
    std::vector<std::vector<std::array<float, 6>>> lanes(width);
    for (int y0 = 0; y0 < scene.resolution.height; y0 += block_height)
      for (int x0 = 0; x0 < scene.resolution.width; x0 += block_width) {
        for (int i = 0; i < width; ++i) {
          const int x = x0 + i % block_width, y = y0 + i / block_width;
          const Vec3<float> origin(camera.position);
          const Vec3<float> direction = normalize(
              Vec3<float>(camera.corner + camera.right * (x + 0.5) + camera.down * (y + 0.5)));
          MediumRay<float> ray;
          ray.origin = origin, ray.direction = direction;
          LocalRay<float> local{Vec3<float>(space.point(camera.position)), space.vector(direction)};
          const Interval<float> inside = space.clip(local);
          const Hit<float> hit = world.closest<float>(origin, direction, 0, true);
          ray.t_enter = inside.t_enter;
          ray.entry = {local(inside.t_enter), local.d};
          ray.t_max = std::max(std::min(hit.t, inside.t_exit) - inside.t_enter, 0.f);
          ray.active = ray.t_max > 0;
          Recorder recorder{world, {}};
          Halves<float> sums;
          sampled.add<1>(
              medium, space, sun, 0, ray, prepared.samples, false,
              Sampler<float>{pixel_hash(prepared.frame.seed, std::uint32_t(x), std::uint32_t(y))},
              recorder, sums);
          lanes[std::size_t(i)] = std::move(recorder.rays);
        }
        for (int s = 0; s < spp; ++s) {
          Packet& packet = packets.emplace_back();
          for (int i = 0; i < width; ++i) {
            const auto& r = lanes[std::size_t(i)][std::size_t(s)];
            const bool active = r[3] != 0 || r[4] != 0 || r[5] != 0;
            packet.valid[i] = active ? -1 : 0;
            count += active;
            packet.ray.org_x[i] = r[0], packet.ray.org_y[i] = r[1], packet.ray.org_z[i] = r[2];
            packet.ray.dir_x[i] = r[3], packet.ray.dir_y[i] = r[4], packet.ray.dir_z[i] = r[5];
            packet.ray.tnear[i] = 0, packet.ray.tfar[i] = 1e18f, packet.ray.time[i] = 0;
            packet.ray.mask[i] = ~0u, packet.ray.flags[i] = 0, packet.ray.id[i] = unsigned(i);
          }
        }
      }
  }

  /// A bare loop over all packets. A query marks its ray by its end, so each packet is copied
  /// first: what a renderer has to write, too.
  void trace(RTCScene scene) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::size_t blocked = 0;
    for (const Packet& packet : packets) {
      typename Packets<width>::Ray ray = packet.ray;
      Packets<width>::occluded(packet.valid, scene, &context, &ray);
      blocked += ray.tfar[0] < 0;
    }
    keep(blocked);
  }
};

template <int width>
void measure(const char* name, const Scene& scene, double bound, const Kernel& kernel,
             std::vector<Row>& rows) {
  RenderSettings settings = scene.render;
  settings.estimator = "rewv";
  settings.isa = kernel.isa;
  settings.threads = 1;
  settings.spp = 16;
  settings.samples_per_ray = 0;
  const FlushToZero flush;
  const World world(scene, Visibility::embree);
  PictureOfRays<width> rays(scene, world, settings);
  Renderer renderer(scene);
  const double ratio = median_ratio(
      7, [&] { rays.trace(world.embree()); }, [&] { renderer.render(settings); });
  rows.push_back({fmt::format("shadow_rays.{}.{}", name, kernel.name), 100 * ratio,
                  "% of bare Embree", Must::at_least(bound), kernel.name});
}

}  // namespace

std::vector<Row> shadow_rays() {
  const Scene rooms[] = {crowded_room(), sunroom()};
  const char* names[] = {"crowded_room", "sunroom"};
  const double bounds[] = {75, 60};
  std::vector<Row> rows;
  for (int i = 0; i < 2; ++i) {
    const Kernel& kernel = kernel_for(InstructionSet::best);
    if (kernel.lanes == 16) measure<16>(names[i], rooms[i], bounds[i], kernel, rows);
    if (kernel.lanes == 8) measure<8>(names[i], rooms[i], bounds[i], kernel, rows);
  }
  return rows;
}

}  // namespace airlight::bench
