#pragma once
/// How a tile is rendered, over a real type: one lane a pixel. Compiled once for each arithmetic.
#include <type_traits>

#include "render/kernel.h"
#include "render/surface_walk.h"

namespace airlight {

/// Pixels are taken in small blocks, one a lane, so that the rays of a packet stay together.
template <Real F>
struct Block {
  static constexpr int height = lanes<F> >= 16 ? 4 : lanes<F> >= 4 ? 2 : 1;
  static constexpr int width = lanes<F> / height;
};

/// Offset of a camera ray from its pixel's centre, drawn from the filter.  [pixels]
template <Real F>
Vec2<F> filter_offset(PixelFilter filter, Vec2<F> u) noexcept {
  if (filter == PixelFilter::box) return {u.x - F(0.5), u.y - F(0.5)};
  if (filter == PixelFilter::tent) {
    const auto tent = [](F v) {
      const F side = sqrt(F(2) * min(v, F(1) - v));
      return select(v < F(0.5), side - F(1), F(1) - side);
    };
    return {tent(u.x), tent(u.y)};
  }
  constexpr double deviation = 0.5, cut = 1.5;
  const F within(1 - 0.011108996538242306);  // 1 − exp(−(cut / deviation)² / 2)
  const F radius = min(F(deviation) * sqrt(F(-2) * log1p_minus(u.x * within)), F(cut));
  F sine, cosine;
  sin_cos_turn(u.y, sine, cosine);
  return {radius * cosine, radius * sine};
}

/// Where light arrives, for the estimator that asks for whole intervals.
struct ExactVisibility {
  const std::vector<ParallelShadows>& shadows;

  template <class Sink>
  void lit(Vec3<double> origin, Vec3<double> direction, double t_max, int light,
           Sink&& sink) const {
    for (const auto& part : shadows[std::size_t(light)].lit(origin, direction, t_max))
      sink(part.t_enter, part.t_exit);
  }
};

/// Adds what one light scatters into one camera ray, by the frame's estimator; `watch` is told of
/// every sample.
template <int channels, Real F, class Space, class L, class Watch>
void add_in_scatter(const Frame& frame, const Space& space, const L& light, int index,
                    const MediumRay<F>& ray, SampleRange samples, const Sampler<F>& sampler,
                    Halves<F>& sums, Watch&& watch) noexcept {
  const bool halve_by_ray = !frame.through_centre;
  if (const auto* sampled = std::get_if<Sampled>(&frame.estimator))
    sampled->template add<channels>(*frame.scene.medium, space, light, index, ray, samples,
                                    halve_by_ray, sampler, frame.world, sums, watch);
  if constexpr (std::same_as<F, double>)
    if (const auto* exact = std::get_if<ClosedForm>(&frame.estimator); exact && ray.active)
      exact->template add<channels>(*frame.scene.medium, space, light, index, ray, samples,
                                    halve_by_ray, ExactVisibility{frame.shadows}, sums);
}

template <int channels, Real F, class Space, class L>
void add_in_scatter(const Frame& frame, const Space& space, const L& light, int index,
                    const MediumRay<F>& ray, SampleRange samples, const Sampler<F>& sampler,
                    Halves<F>& sums) noexcept {
  add_in_scatter<channels>(frame, space, light, index, ray, samples, sampler, sums,
                           [](const WatchedSample<F>&) {});
}

/// Is told of every camera ray while a tile is rendered; this one does not listen.
struct Unwatched {
  template <Real F, class Space>
  void camera_ray(const SurfaceWalk<F, Space>&, Vec3<F> /*direction*/, Interval<F> /*inside*/,
                  SampleRange) const noexcept {}
  /// The same ray's part in the medium, if it has one.
  template <Real F>
  void medium_ray(const MediumRay<F>&) const noexcept {}
};

template <Real F, class Space, class Watcher>
class TileKernel {
 public:
  TileKernel(const Frame& frame, Tile& tile, const Medium* medium, const Space& space,
             Watcher& watcher) noexcept
      : frame_(frame), tile_(tile), medium_(medium), space_(space), watcher_(watcher) {
    if (medium) camera_local_ = Vec3<F>(space.point(frame.camera.position));
  }

  void render() const noexcept {
    for (int y = 0; y < tile_.rect.height; y += Block<F>::height)
      for (int x = 0; x < tile_.rect.width; x += Block<F>::width) packet(x, y);
  }

 private:
  /// Samples summed in F before they are added to the tile's sums in double: longer runs of floats
  /// drift.
  static constexpr std::uint32_t longest_run = 1024;

  void packet(int x0, int y0) const noexcept {
    alignas(64) Scalar<F> px[lanes<F>], py[lanes<F>];
    std::array<int, std::size_t(lanes<F>)> pixel;
    std::array<std::uint32_t, std::size_t(lanes<F>)> hash;
    std::uint32_t inside = 0;
    for (int i = 0; i < lanes<F>; ++i) {
      const int x = x0 + i % Block<F>::width, y = y0 + i / Block<F>::width;
      const bool in = x < tile_.rect.width && y < tile_.rect.height;
      const int X = tile_.rect.x0 + (in ? x : x0), Y = tile_.rect.y0 + (in ? y : y0);
      px[i] = Scalar<F>(X) + Scalar<F>(0.5), py[i] = Scalar<F>(Y) + Scalar<F>(0.5);
      hash[std::size_t(i)] = pixel_hash(frame_.seed, std::uint32_t(X), std::uint32_t(Y));
      pixel[std::size_t(i)] = in ? y * tile_.rect.width + x : -1;
      inside |= std::uint32_t(in) << i;
    }
    const Sampler<F> sampler{load_bits<F>(hash.data())};
    const Mask<F> active = mask_from_bits<F>(inside);
    const F x = load<F>(px), y = load<F>(py);

    PixelSums<F> sums;
    const std::uint32_t end = tile_.samples.first + tile_.samples.count;
    std::uint32_t held = 0;
    for (std::uint32_t i = tile_.samples.first; i < end;) {
      const std::uint32_t index = i / frame_.samples_per_ray;
      const std::uint32_t stop = std::min(end, (index + 1) * frame_.samples_per_ray);
      const bool first = i == tile_.samples.first;
      camera_ray(x, y, index, {i, stop - i}, sampler, active, first ? &pixel : nullptr, sums);
      held += stop - i;
      i = stop;
      if (held >= longest_run) spill(sums, pixel), held = 0;
    }
    spill(sums, pixel);
  }

  void camera_ray(F x, F y, std::uint32_t index, SampleRange samples, const Sampler<F>& sampler,
                  Mask<F> active, const std::array<int, std::size_t(lanes<F>)>* first_of,
                  PixelSums<F>& sums) const noexcept {
    if (!frame_.through_centre) {
      const Vec2<F> offset = filter_offset(frame_.filter, sampler.two(index, stream::camera));
      x = x + offset.x, y = y + offset.y;
    }
    const CameraFrame& camera = frame_.camera;
    const Vec3<F> origin(camera.position);
    const Vec3<F> direction =
        normalize(Vec3<F>(camera.corner) + Vec3<F>(camera.right) * x + Vec3<F>(camera.down) * y);

    LocalRay<F> local{camera_local_, Vec3<F>()};
    Interval<F> inside{F(0), F(0)};
    if (medium_) {
      local.d = space_.vector(direction);
      inside = space_.clip(local);
      inside.t_exit = max(inside.t_exit, inside.t_enter);
    }

    SurfaceWalk<F, Space> walk(frame_, medium_, space_, sampler);
    walk.along(origin, direction, inside, samples, active);
    watcher_.camera_ray(walk, direction, inside, samples);

    const F n(Scalar<F>(samples.count));
    const bool halve_by_ray = !frame_.through_centre;
    for (std::uint32_t i = samples.first; i < samples.first + samples.count; ++i) {
      const int half = half_of(halve_by_ray ? index : i);
      sums.samples[std::size_t(half)] += F(1);
      sums.in_scatter[std::size_t(half)].plain += walk.emission;
    }
    sums.surface += walk.radiance * n;
    sums.transmittance += walk.through * n;
    sums.albedo += walk.albedo * n;
    sums.normal = sums.normal + walk.normal * n;
    if (first_of)
      for (int i = 0; i < lanes<F>; ++i)
        if (const int p = (*first_of)[std::size_t(i)]; p >= 0) {
          auto& row = tile_.pixels[std::size_t(p)];
          row[PixelSums<F>::added] = double(lane(walk.depth, i));
          row[PixelSums<F>::added + 1] = double(lane(walk.object, i));
        }

    if (!medium_) return;
    MediumRay<F> ray = medium_ray({origin, direction, walk.t_end}, local, inside);
    ray.active = active & ray.active;
    ray.index = index;
    ray.filtered = walk.filtered;
    if (!any(ray.active)) return;
    watcher_.medium_ray(ray);

    for (int i = 0; i < int(frame_.scene.lights.size()); ++i)
      std::visit(
          [&](const auto& light) {
            if (medium_->is_grey())
              add_in_scatter<1>(frame_, space_, light, i, ray, samples, sampler, sums.in_scatter);
            else
              add_in_scatter<3>(frame_, space_, light, i, ray, samples, sampler, sums.in_scatter);
          },
          frame_.scene.lights[std::size_t(i)]);
  }

  /// Adds a packet's sums, a lane a pixel, to the tile's. Many are zero: an estimator uses some of
  /// the four.
  void spill(PixelSums<F>& sums,
             const std::array<int, std::size_t(lanes<F>)>& pixel) const noexcept {
    const auto values = sums.row();
    for (std::size_t k = 0; k < PixelSums<F>::added; ++k) {
      if (!any(values[k] != F(0))) continue;
      alignas(64) Scalar<F> lane_values[lanes<F>];
      store(values[k], lane_values);
      for (int i = 0; i < lanes<F>; ++i)
        if (const int p = pixel[std::size_t(i)]; p >= 0)
          tile_.pixels[std::size_t(p)][k] += double(lane_values[i]);
    }
    sums = {};
  }

  const Frame& frame_;
  Tile& tile_;
  const Medium* medium_;
  const Space& space_;
  Watcher& watcher_;
  Vec3<F> camera_local_;
};

template <Real F, class Watcher>
void render_tile(const Frame& frame, Tile& tile, Watcher& watcher) {
  if (!frame.scene.medium) {
    const Unbounded::Space nowhere;
    return TileKernel<F, Unbounded::Space, Watcher>(frame, tile, nullptr, nowhere, watcher)
        .render();
  }
  std::visit(
      [&](const auto& shape) {
        const auto space = shape.space();
        TileKernel<F, std::remove_const_t<decltype(space)>, Watcher>(
            frame, tile, &*frame.scene.medium, space, watcher)
            .render();
      },
      frame.scene.medium->shape);
}

template <Real F>
void render_tile(const Frame& frame, Tile& tile) {
  Unwatched nobody;
  render_tile<F>(frame, tile, nobody);
}

template <Real F>
void transmittance_integrals(const Box& box, Vec3<double> toward, double sigma_t, std::size_t count,
                             const float* const rays[6], float* integrals) {
  const Box::Space space = box.space();
  const auto outward = space.outward(space.vector(Vec3<F>(toward)));
  const F sigma(static_cast<Scalar<F>>(sigma_t));
  const auto packet = [&](const float* const in[6], float* out) {
    const Vec3<F> origin(load<F>(in[0]), load<F>(in[1]), load<F>(in[2]));
    const Vec3<F> direction(load<F>(in[3]), load<F>(in[4]), load<F>(in[5]));
    LocalRay<F> ray{space.point(origin), space.vector(direction)};
    const Interval<F> inside = space.clip(ray);
    const F t_max = inside.t_exit - inside.t_enter;
    const Mask<F> hit = t_max > F(0);
    ray.o = select(hit, ray(inside.t_enter), Vec3<F>());
    const auto way = space.way_out(ray, outward, select(hit, t_max, F(0)));
    store(Trapezoids<F, 3>(way, sigma).transmittance_integral(), out);
  };
  std::size_t i = 0;
  for (; i + lanes<F> <= count; i += lanes<F>) {
    const float* const in[6] = {rays[0] + i, rays[1] + i, rays[2] + i,
                                rays[3] + i, rays[4] + i, rays[5] + i};
    packet(in, integrals + i);
  }
  if (i == count) return;
  float rest[6][lanes<F>] = {}, out[lanes<F>];
  for (int k = 0; k < 6; ++k)
    for (std::size_t j = i; j < count; ++j) rest[k][j - i] = rays[k][j];
  const float* const in[6] = {rest[0], rest[1], rest[2], rest[3], rest[4], rest[5]};
  packet(in, out);
  for (std::size_t j = i; j < count; ++j) integrals[j] = out[j - i];
}

template <Real F>
constexpr Kernel make_kernel(InstructionSet isa, const char* name) {
  return {isa, name, lanes<F>, &render_tile<F>, &transmittance_integrals<F>};
}

}  // namespace airlight
