#include "paths.h"

#include <fmt/format.h>

#include "geometry/flush_to_zero.h"
#include "geometry/packet.h"
#include "measure.h"
#include "render/path_kernel.h"
#include "render/prepare.h"
#include "render/render.h"
#include "scenes.h"

namespace airlight::bench {
namespace {

/// A ray as it is asked for; without a direction: not asked.
struct Asked {
  Vec3<float> origin, direction;
  float t_from = 0;
};

/// What a vertex of a path asks: where its segment ends, and whether the sun reaches a point of it
/// and the surface at its end.
struct Vertex {
  bool first;  ///< of its path
  Asked segment, from_medium, from_surface;
};

/// A world in which the sun always shines, that writes down who asks.
struct Recorder {
  Asked& asked;

  Rgb<float> transmit(Vec3<float> from, Vec3<float> to, float, int, bool active) const {
    if (active) asked = {from, to, 0};
    return Rgb<float>(1.f);
  }
};

/// Writes down the rays of every vertex, path after path.
class Vertices {
 public:
  std::vector<Vertex> all;

  explicit Vertices(const Frame& frame)
      : frame_(frame),
        space_(std::get<Box>(frame.scene.media.front().shape).space()),
        sun_(std::get<Directional>(frame.scene.lights.at(0))) {}

  void begins(const Paths<float>& paths) {
    Vertex vertex;
    vertex.first = paths.points.vertex == 0;
    vertex.segment = {paths.origin, paths.direction, paths.t_from};
    const Hit<float> hit =
        frame_.world.closest<float>(paths.origin, paths.direction, paths.t_from, true);
    const Medium& medium = frame_.scene.media.front();
    const MediumRay<float> ray =
        medium_ray(CameraRay<float>{paths.origin, paths.direction, hit.t}, space_);
    Halves<float> sums;
    const Recorder recorder{vertex.from_medium};
    const auto& sampled = std::get<Sampled>(frame_.estimator);
    if (ray.active)
      sampled.add<3>(medium, space_, sun_, 0, ray, {0, 1}, false, paths.points, recorder, sums);
    if (hit.found) {
      const SurfaceLight<float, Box::Space, PathSampler<float>> surfaces(
          frame_, &medium, space_, paths.points, Bundle::loose);
      const Crossing<float> at = surfaces.crossing(hit, true, paths.origin, paths.direction);
      const Vec3<float> w = uniform_cap(Vec3<float>(sun_.toward()), float(sun_.cap_height()),
                                        paths.points.two(0, stream::surface(0)));
      if (dot(at.normal, w) > 0 && dot(at.geometric, w) > 0) vertex.from_surface = {at.above, w, 0};
    }
    all.push_back(vertex);
  }
  template <class... What>
  void gathers(const What&...) const noexcept {}
  template <class... What>
  void goes_on(const What&...) const noexcept {}

 private:
  const Frame& frame_;
  Box::Space space_;
  const Directional& sun_;
};

/// The same rays in packets: a path a lane, the next one where one ends, as the kernel has them.
template <int width>
class PacketsOfRays {
  using Calls = PacketCalls<width>;
  struct alignas(64) Packet {
    alignas(64) int valid[width];
    typename Calls::RayHit ray;
    bool any = false;

    void set(int i, const Asked& asked) {
      const Vec3<float>& d = asked.direction;
      const bool active = d.x != 0 || d.y != 0 || d.z != 0;
      auto& r = ray.ray;
      any |= active;
      valid[i] = active ? -1 : 0;
      r.org_x[i] = asked.origin.x, r.org_y[i] = asked.origin.y, r.org_z[i] = asked.origin.z;
      r.dir_x[i] = d.x, r.dir_y[i] = d.y, r.dir_z[i] = d.z;
      r.tnear[i] = asked.t_from * 1.0000005f, r.tfar[i] = 1e18f, r.time[i] = 0;
      r.mask[i] = ~0u, r.flags[i] = 0, r.id[i] = unsigned(i);
      ray.hit.geomID[i] = ray.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  };
  struct Round {
    Packet segment, from_medium, from_surface;
  };
  std::vector<Round> rounds_;

 public:
  explicit PacketsOfRays(const std::vector<Vertex>& vertices) {
    std::size_t next = 0;  // the first vertex of the next path
    std::array<std::size_t, width> at{}, end{};
    const auto end_of_path = [&](std::size_t i) {
      do ++i;
      while (i < vertices.size() && !vertices[i].first);
      return i;
    };
    while (true) {
      Round round;
      bool any = false;
      for (int i = 0; i < width; ++i) {
        const auto k = std::size_t(i);
        if (at[k] == end[k] && next < vertices.size()) {
          at[k] = next, end[k] = next = end_of_path(next);
        }
        const bool busy = at[k] < end[k];
        const Vertex vertex = busy ? vertices[at[k]++] : Vertex{};
        any |= busy;
        round.segment.set(i, vertex.segment);
        round.from_medium.set(i, vertex.from_medium);
        round.from_surface.set(i, vertex.from_surface);
      }
      if (!any) break;
      rounds_.push_back(round);
    }
  }

  /// Nothing but Embree. A query writes into its packet, so each is copied first: what a renderer
  /// has to write, too.
  void trace(RTCScene scene) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::size_t found = 0;
    const auto shadow = [&](const Packet& packet) {
      if (!packet.any) return;
      auto ray = packet.ray.ray;
      Calls::occluded(packet.valid, scene, &context, &ray);
      found += ray.tfar[0] < 0;
    };
    for (const Round& round : rounds_) {
      auto ray = round.segment.ray;
      Calls::intersect(round.segment.valid, scene, &context, &ray);
      found += ray.ray.tfar[0] < 1e18f;
      shadow(round.from_medium);
      shadow(round.from_surface);
    }
    keep(found);
  }
};

template <int width>
void measure(const Kernel& kernel, std::vector<Row>& rows) {
  Scene scene = sunroom();
  scene.resolution = {160, 90};  // so that all rays fit into memory
  RenderSettings settings = scene.render;
  settings.isa = kernel.isa;
  settings.threads = 1;
  settings.max_depth = 8;
  settings.spp = 8;
  const FlushToZero flush;
  const World world(scene, Visibility::embree);
  const Prepared prepared = prepare(scene, world, settings);
  Film film(scene.resolution, {0, 0, 160, 90}, prepared.frame.layout, light_group_names(scene));
  Vertices vertices(prepared.frame);
  for (int index = 0; index < film.tile_count(); ++index) {
    Tile tile{film.tile(index), prepared.samples, film};
    render_paths<float>(prepared.frame, tile, vertices);
  }
  const PacketsOfRays<width> rays(vertices.all);

  Renderer renderer(scene);
  PathCount count;
  const double ratio = median_ratio(
      7, [&] { rays.trace(world.embree()); }, [&] { count = renderer.render(settings).paths; });
  const double each = median_seconds(3, [&] { renderer.render(settings); });
  rows.push_back({fmt::format("paths.bare.{}", kernel.name), 100 * ratio, "% of bare Embree",
                  Must::at_least(50), kernel.name});
  rows.push_back({fmt::format("paths.lanes.{}", kernel.name),
                  100 * double(count.vertices) / double(count.offered), "% in use",
                  Must::at_least(80), kernel.name});
  rows.push_back({fmt::format("paths.vertices.{}", kernel.name),
                  double(count.vertices) / each * 1e-6,
                  "million/s",
                  {},
                  kernel.name});
}

}  // namespace

std::vector<Row> paths() {
  const Kernel& kernel = kernel_for(InstructionSet::best);
  std::vector<Row> rows;
  if (kernel.lanes == 16) measure<16>(kernel, rows);
  if (kernel.lanes == 8) measure<8>(kernel, rows);
  return rows;
}

}  // namespace airlight::bench
