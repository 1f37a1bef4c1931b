#include "shadow_rays.h"

#include <fmt/format.h>

#include "geometry/flush_to_zero.h"
#include "geometry/packet.h"
#include "geometry/world.h"
#include "measure.h"
#include "render/prepare.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// Shadow rays as an estimator asks for them, written down.
struct Recorder {
  mutable std::vector<std::array<float, 6>> rays;

  Rgb<float> transmit(Vec3<float> from, Vec3<float> to, float, int, bool active) const {
    if (active)
      rays.push_back({from.x, from.y, from.z, to.x, to.y, to.z});
    else
      rays.push_back({0, 0, 0, 0, 0, 0});
    return Rgb<float>(1.f);
  }
};

using ShadowRay = std::array<float, 6>;  ///< origin and direction; a direction of 0 is none

/// The shadow rays of a picture with one camera ray through each pixel's centre, in the packets of
/// a kernel of this width: a block of pixels, the same sample of each, first those of its surfaces.
template <int width>
struct PictureOfRays {
  struct alignas(64) Packet {
    typename PacketCalls<width>::Ray ray;
    alignas(64) int valid[width];
    Bundle bundle;
  };
  std::vector<Packet> packets;

  PictureOfRays(const Scene& scene, const World& world, const RenderSettings& settings) {
    const Prepared prepared = prepare(scene, world, settings);
    constexpr int block_height = width >= 16 ? 4 : 2, block_width = width / block_height;
    for (int y0 = 0; y0 < scene.resolution.height; y0 += block_height)
      for (int x0 = 0; x0 < scene.resolution.width; x0 += block_width) {
        std::array<std::vector<ShadowRay>, width> lanes;
        for (int i = 0; i < width; ++i)
          lanes[std::size_t(i)] =
              rays_of_pixel(prepared, x0 + i % block_width, y0 + i / block_width);
        for (std::size_t s = 0; s < lanes[0].size(); ++s)
          add_packet(lanes, s, s < surface_rays(prepared) ? Bundle::tight : Bundle::loose);
      }
  }

  /// How many of a pixel's rays its surface asks for.
  static std::uint32_t surface_rays(const Prepared& prepared) {
    if (!(std::get<Directional>(prepared.frame.scene.lights.at(0)).angular_diameter > 0)) return 1;
    const std::uint32_t sharing = prepared.frame.samples_per_surface_ray;
    return (prepared.samples.count + sharing - 1) / sharing;
  }

  /// What the renderer asks for a pixel, in its order.
  static std::vector<ShadowRay> rays_of_pixel(const Prepared& prepared, int x, int y) {
    const Frame& frame = prepared.frame;
    const Medium& medium = frame.scene.media[0];
    const Box::Space space = std::get<Box>(medium.shape).space();
    const auto& sun = std::get<Directional>(frame.scene.lights.at(0));
    const CameraFrame& camera = frame.camera;
    const Sampler<float> sampler{pixel_hash(frame.seed, std::uint32_t(x), std::uint32_t(y))};

    const Vec3<float> origin(camera.position);
    const Vec3<float> direction =
        normalize(Vec3<float>(camera.corner + camera.right * (x + 0.5) + camera.down * (y + 0.5)));
    const Hit<float> hit = frame.world.closest<float>(origin, direction, 0, true);
    Recorder recorder;

    for (std::uint32_t i = 0; i < surface_rays(prepared); ++i) {
      const Vec3<float> w = uniform_cap(Vec3<float>(sun.toward()), float(sun.cap_height()),
                                        sampler.two(i, stream::surface(0)));
      bool faces = false;
      Vec3<float> from = origin + direction * hit.t;
      if (hit.found) {
        Vec3<float> n =
            normalize(frame.world.surface(hit.object[0], hit.primitive[0], hit.u[0], hit.v[0])
                          .geometric_normal);
        if (dot(n, direction) > 0) n = -n;
        faces = dot(n, w) > 0;
        from = from + n * 1e-4f;
      }
      recorder.transmit(from, w, 0, 0, faces);
    }

    const LocalRay<float> local{Vec3<float>(space.point(camera.position)), space.vector(direction)};
    const Interval<float> inside = space.clip(local);
    MediumRay<float> ray;
    ray.origin = origin, ray.direction = direction;
    ray.t_enter = inside.t_enter;
    ray.entry = {local(inside.t_enter), local.d};
    ray.t_max = std::max(std::min(hit.t, inside.t_exit) - inside.t_enter, 0.f);
    ray.active = ray.t_max > 0;
    Halves<float> sums;
    const auto& sampled = std::get<Sampled>(frame.estimator);
    for (std::uint32_t i = 0; i < prepared.samples.count; i += frame.samples_per_ray, ++ray.index) {
      const SampleRange some{i, std::min(frame.samples_per_ray, prepared.samples.count - i)};
      if (medium.is_grey())
        sampled.add<1>(medium, space, sun, 0, ray, some, false, sampler, recorder, sums);
      else
        sampled.add<3>(medium, space, sun, 0, ray, some, false, sampler, recorder, sums);
    }
    return std::move(recorder.rays);
  }

  void add_packet(const std::array<std::vector<ShadowRay>, width>& lanes, std::size_t sample,
                  Bundle bundle) {
    Packet packet;
    packet.bundle = bundle;
    bool any = false;
    for (int i = 0; i < width; ++i) {
      const ShadowRay& r = lanes[std::size_t(i)][sample];
      const bool active = r[3] != 0 || r[4] != 0 || r[5] != 0;
      any |= active;
      packet.valid[i] = active ? -1 : 0;
      packet.ray.org_x[i] = r[0], packet.ray.org_y[i] = r[1], packet.ray.org_z[i] = r[2];
      packet.ray.dir_x[i] = r[3], packet.ray.dir_y[i] = r[4], packet.ray.dir_z[i] = r[5];
      packet.ray.tnear[i] = 0, packet.ray.tfar[i] = 1e18f, packet.ray.time[i] = 0;
      packet.ray.mask[i] = ~0u, packet.ray.flags[i] = 0, packet.ray.id[i] = unsigned(i);
    }
    if (any) packets.push_back(packet);  // the renderer doesn't ask for nothing either
  }

  /// A bare loop over all packets. A query marks its ray by its end, so each packet is copied
  /// first: what a renderer has to write, too.
  void trace(RTCScene scene) {
    PacketContext loose(Bundle::loose), tight(Bundle::tight);
    std::size_t blocked = 0;
    for (const Packet& packet : packets) {
      typename PacketCalls<width>::Ray ray = packet.ray;
      PacketContext& context = packet.bundle == Bundle::tight ? tight : loose;
      PacketCalls<width>::occluded(packet.valid, scene, &context.embree, &ray);
      blocked += ray.tfar[0] < 0;
    }
    keep(blocked);
  }
};

template <int width>
void measure(const char* name, Scene scene, double bound, const Kernel& kernel,
             std::vector<Row>& rows) {
  scene.resolution = {320, 180};  // so that all rays fit into memory
  RenderSettings settings = scene.render;
  settings.estimator = "rewv";
  settings.isa = kernel.isa;
  settings.threads = 1;
  settings.spp = 64;
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
