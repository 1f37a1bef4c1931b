#pragma once
/// How a tile is rendered, over a real type: one lane a pixel. Compiled once for each arithmetic.
#include <algorithm>
#include <bit>
#include <span>
#include <type_traits>
#include <vector>

#include "render/background.h"
#include "render/camera_ray.h"
#include "render/kernel.h"
#include "render/light_shares.h"
#include "render/path_kernel.h"
#include "render/surface_walk.h"

namespace airlight {

/// Pixels are taken in small blocks, one a lane, so that the rays of a packet stay together.
template <Real F>
struct Block {
  static constexpr int height = lanes<F> >= 16 ? 4 : lanes<F> >= 4 ? 2 : 1;
  static constexpr int width = lanes<F> / height;
};

/// The sums of a packet of pixels, one a lane, until they go to the film.
template <Real F>
struct PacketSums {
  struct Group {
    Halves<F> in_scatter;
    Rgb<F> surface;
    HoldoutLight<F> holdout_light;
  };
  std::vector<Group> groups;
  Rgb<F> transmittance, albedo;
  Vec3<F> normal;
  HoldoutSums<F> holdouts;
  F depth, object;                         ///< of the first camera ray
  std::array<std::uint32_t, 2> samples{};  ///< in each half, of every pixel

  explicit PacketSums(const FilmLayout& layout) : groups(std::size_t(layout.groups)) {}

  /// Adds the sums of the active lanes to the film's and starts again from zero. Returns how many
  /// lanes were left out because something in them is not finite.
  int spill(const FilmLayout& layout, FilmPixels to, Mask<F> active) noexcept {
    F poison(0);  // stays zero but where a number is infinite or none
    for_each(
        layout, [&](int, F total, const int*, F) { poison = fma(total, F(0), poison); },
        [&](int, F feature) { poison = fma(feature, F(0), poison); });
    const Mask<F> good = active & (poison == F(0));
    // Sums that are still zero are written, not read: fresh memory that is read first costs the
    // system two page faults.
    std::uint32_t gathered = 0;
    for (int i = 0; i < lanes<F>; ++i)
      gathered |= to.samples[i] | to.samples[i + film_block::pixels];
    const auto add = [&](auto* numbers, int row, F values) {
      auto* to_row = numbers + row * film_block::pixels;
      alignas(64) Scalar<F> added[lanes<F>];
      store(select(good, values, F(0)), added);
      if (gathered == 0)
        std::copy_n(added, lanes<F>, to_row);
      else
        for (int i = 0; i < lanes<F>; ++i) to_row[i] += added[i];
    };
    for_each(
        layout,
        [&](int row, F total, const int* second_row, F second) {
          add(to.sums, row, total);
          if (second_row) add(to.features, *second_row, second);
        },
        [&](int row, F feature) { add(to.features, row, feature); });
    const std::uint32_t kept = bits<F>(good);
    alignas(64) Scalar<F> depths[lanes<F>], objects[lanes<F>];
    store(depth, depths), store(object, objects);
    float* const to_depths = to.features + FilmLayout::depth * film_block::pixels;
    float* const to_objects = to.features + FilmLayout::object * film_block::pixels;
    for (int i = 0; i < lanes<F>; ++i) {
      const std::uint32_t keeps = (kept >> i) & 1u;
      std::uint32_t &first = to.samples[i], &second = to.samples[i + film_block::pixels];
      const bool is_first = keeps && first + second == 0;
      to_depths[i] = is_first ? float(depths[i]) : to_depths[i];
      to_objects[i] = is_first ? float(objects[i]) : to_objects[i];
      first += keeps * samples[0], second += keeps * samples[1];
    }
    for (Group& group : groups) group = {};
    transmittance = albedo = {}, normal = {}, holdouts = {}, samples = {};
    return std::popcount(bits<F>(active) & ~kept);
  }

 private:
  /// sum(row, total, row of the second half or null, second half) for what adds up to radiance,
  /// feature(row, value) for the rest.
  template <class Sum, class Feature>
  void for_each(const FilmLayout& layout, Sum&& sum, Feature&& feature) const noexcept {
    for (int g = 0; g < layout.groups; ++g) {
      const Group& group = groups[std::size_t(g)];
      const auto& [one, two] = group.in_scatter;
      int row = layout.in_scatter(g), second_row = layout.second_half(g);
      const auto halves = [&](const Rgb<F>& a, const Rgb<F>& b) {
        for (int c = 0; c < 3; ++c, ++row, ++second_row) sum(row, a[c] + b[c], &second_row, b[c]);
      };
      if (layout.plain) halves(one.plain, two.plain);
      if (layout.ratio) {
        halves(one.analytic, two.analytic);
        halves(one.occluded, two.occluded);
        halves(one.unoccluded, two.unoccluded);
      }
      for (int c = 0; c < 3; ++c) sum(row + c, group.surface[c], nullptr, F(0));
    }
    for (int c = 0; c < 3; ++c) {
      feature(FilmLayout::transmittance + c, transmittance[c]);
      feature(FilmLayout::albedo + c, albedo[c]);
      feature(FilmLayout::normal + c, normal[c]);
    }
    if (!layout.shadow) return;
    for (int c = 0; c < 3; ++c) {
      sum(layout.plate() + c, holdouts.plate[c], nullptr, F(0));
      feature(layout.holdouts() + c, holdouts.seen[c]);
    }
    for (int g = 0; g < layout.groups; ++g) {
      const auto& [lit, was_lit] = groups[std::size_t(g)].holdout_light;
      const int row = layout.holdout_light(g);
      for (int c = 0; c < 3; ++c) feature(row + c, lit[c]), feature(row + 3 + c, was_lit[c]);
    }
  }
};

/// Where the lit parts of a ray are put together, one at a time, by the exact estimator: place for
/// those of any ray and light.
using ShadowRoom = std::vector<Interval<double>>;

inline ShadowRoom shadow_room(const Frame& frame) {
  std::size_t most = 0;
  for (const ParallelShadows& shadows : frame.shadows) most = std::max(most, shadows.most_parts());
  return ShadowRoom(most);
}

/// Where light arrives, for the estimator that asks for whole intervals.
struct ExactVisibility {
  const std::vector<ParallelShadows>& shadows;
  std::span<Interval<double>> room;  ///< as ShadowRoom

  template <class Sink>
  void lit(Vec3<double> origin, Vec3<double> direction, double t_max, int light,
           Sink&& sink) const {
    for (const auto& part : shadows[std::size_t(light)].lit(origin, direction, t_max, room))
      sink(part.t_enter, part.t_exit);
  }
};

/// Adds what one light scatters into one camera ray, by the frame's estimator, from the samples
/// that the light shares in; `watch` is told of every one of them.
template <int channels, Real F, class Space, class L, class Watch>
void add_in_scatter(const Frame& frame, const Space& space, const L& light, int index,
                    const MediumRay<F>& ray, SampleRange samples, const LightShare<F>* share,
                    const Sampler<F>& sampler, ShadowRoom& room, Halves<F>& sums,
                    Watch&& watch) noexcept {
  if (const auto* sampled = std::get_if<Sampled>(&frame.estimator))
    sampled->template add<channels>(frame.scene.media[0], space, light, index, ray, samples,
                                    frame.halves_by_ray(), sampler, frame.world, sums, watch,
                                    share);
  if constexpr (std::same_as<F, double>)
    if (const auto* exact = std::get_if<ClosedForm>(&frame.estimator); exact && ray.active)
      exact->template add<channels>(frame.scene.media[0], space, light, index, ray, samples,
                                    frame.halves_by_ray(), ExactVisibility{frame.shadows, room},
                                    sums);
}

template <int channels, Real F, class Space, class L>
void add_in_scatter(const Frame& frame, const Space& space, const L& light, int index,
                    const MediumRay<F>& ray, SampleRange samples, const LightShare<F>* share,
                    const Sampler<F>& sampler, ShadowRoom& room, Halves<F>& sums) noexcept {
  add_in_scatter<channels>(frame, space, light, index, ray, samples, share, sampler, room, sums,
                           [](const WatchedSample<F>&) {});
}

/// Is told of every camera ray while a tile is rendered; this one does not listen.
struct Unwatched {
  template <Real F, class Space>
  void camera_ray(const SurfaceWalk<F, Space>&, Vec3<F> /*direction*/, SampleRange) const noexcept {
  }
  /// The same ray's part in the medium, if it has one.
  template <Real F>
  void medium_ray(const MediumRay<F>&) const noexcept {}
};

template <Real F, class Space, class Watcher>
class TileKernel {
 public:
  TileKernel(const Frame& frame, Tile& tile, const Medium* medium, const Space& space,
             Watcher& watcher)
      : frame_(frame),
        tile_(tile),
        medium_(medium),
        space_(space),
        watcher_(watcher),
        sums_(frame.layout),
        walk_room_(frame.layout),
        weights_(frame.scene.lights.size(), F(0)),
        room_(shadow_room(frame)) {
    if (medium) camera_local_ = Vec3<F>(space.point(frame.camera.position));
  }

  void render() noexcept {
    for (int y = 0; y < tile_.rect.height; y += Block<F>::height)
      for (int x = 0; x < tile_.rect.width; x += Block<F>::width)
        packet(tile_.rect.x0 + x, tile_.rect.y0 + y);
  }

 private:
  /// The pixels from (x0, y0) of the film on.
  void packet(int x0, int y0) noexcept {
    const PixelRect& rect = tile_.rect;
    const PixelRect& crop = tile_.film.crop;
    const auto& lane = film_block::places<float>;
    const auto& lane_bits = film_block::places<std::uint32_t>;
    const F right = load<F>(lane.x.data()), down = load<F>(lane.y.data());
    const Mask<F> active = (right < F(Scalar<F>(rect.x0 + rect.width - x0))) &
                           (down < F(Scalar<F>(rect.y0 + rect.height - y0)));
    // Lanes beyond the edge follow the first one's ray.
    const auto beside = [&](int first, F offset) {
      return F(Scalar<F>(first) + Scalar<F>(0.5)) + select(active, offset, F(0));
    };
    const F x = beside(crop.x0 + x0, right), y = beside(crop.y0 + y0, down);
    const auto number = [](int first, const auto& offsets) {
      return UInt<F>(std::uint32_t(first)) + load_bits<F>(offsets.data());
    };
    const Sampler<F> sampler{pixel_hash<UInt<F>>(frame_.seed, number(crop.x0 + x0, lane_bits.x),
                                                 number(crop.y0 + y0, lane_bits.y))};
    const Rgb<F> background = background_at(frame_.scene, x, y);

    const std::uint32_t end = tile_.samples.first + tile_.samples.count;
    for (std::uint32_t i = tile_.samples.first; i < end;) {
      const std::uint32_t index = i / frame_.samples_per_ray;
      // Through the centre, one walk along the surfaces serves all.
      const std::uint32_t stop =
          frame_.through_centre ? end : std::min(end, (index + 1) * frame_.samples_per_ray);
      camera_ray(x, y, background, index, {i, stop - i}, sampler, active, i == tile_.samples.first);
      i = stop;
    }
    tile_.rejected += sums_.spill(frame_.layout, tile_.film.at(x0, y0), active);
  }

  void camera_ray(F x, F y, Rgb<F> background, std::uint32_t index, SampleRange samples,
                  const Sampler<F>& sampler, Mask<F> active, bool is_first) noexcept {
    if (!frame_.through_centre) {
      const Vec2<F> offset = filter_offset(frame_.filter, sampler.two(index, stream::camera));
      x = x + offset.x, y = y + offset.y;
    }
    const Vec3<F> origin(frame_.camera.position);
    const Vec3<F> direction = camera_direction(frame_.camera, x, y);

    LocalRay<F> local{camera_local_, Vec3<F>()};
    if (medium_) local.d = space_.vector(direction);
    const auto inside = stretches_of(medium_, space_, local);

    SurfaceWalk<F, Space> walk(frame_, medium_, space_, sampler, walk_room_);
    walk.background = background;
    walk.along(origin, direction, inside, samples, active);

    const F n(Scalar<F>(samples.count));
    Halves<F>& ungrouped = sums_.groups[Frame::ungrouped].in_scatter;
    const std::uint32_t end = samples.first + samples.count;
    std::array<std::uint32_t, 2> counts{};
    for (std::uint32_t i = samples.first; i < end; ++i)
      ++counts[std::size_t(half_of(frame_.halves_by_ray() ? index : i))];
    for (std::size_t half = 0; half < counts.size(); ++half) {
      sums_.samples[half] += counts[half];
      ungrouped[half].plain += walk.emission * Rgb<F>(F(Scalar<F>(counts[half])));
    }
    for (std::size_t g = 0; g < sums_.groups.size(); ++g) {
      sums_.groups[g].surface += walk.radiance[g] * n;
      if (frame_.layout.shadow) sums_.groups[g].holdout_light += walk.holdout_light[g] * Rgb<F>(n);
    }
    sums_.transmittance += walk.uncovered * n;
    if (frame_.layout.shadow) sums_.holdouts += walk.holdouts * n;
    sums_.albedo += walk.albedo * n;
    sums_.normal = sums_.normal + walk.normal * n;
    if (is_first) sums_.depth = walk.depth, sums_.object = walk.object;

    MediumRay<F> ray =
        medium_ray({origin, direction, medium_ ? walk.t_end : F(0)}, local, inside.hull());
    ray.active = active & ray.active;
    ray.filtered = walk.filtered;
    for (std::uint32_t i = samples.first; i < end;) {
      ray.index = i / frame_.samples_per_ray;
      const std::uint32_t stop = std::min(end, (ray.index + 1) * frame_.samples_per_ray);
      in_scatter(walk, ray, {i, stop - i}, sampler);
      i = stop;
    }
  }

  /// Adds what all lights scatter into a camera ray, from the samples that share directions to
  /// discs.
  void in_scatter(const SurfaceWalk<F, Space>& walk, const MediumRay<F>& ray, SampleRange samples,
                  const Sampler<F>& sampler) noexcept {
    watcher_.camera_ray(walk, ray.direction, samples);
    if (!any(ray.active)) return;
    watcher_.medium_ray(ray);
    const auto add = [&](int i, const LightShare<F>* share) {
      Halves<F>& sums = sums_.groups[std::size_t(frame_.light_group[std::size_t(i)])].in_scatter;
      std::visit(
          [&](const auto& light) {
            if (is_grey(*medium_, space_))
              add_in_scatter<1>(frame_, space_, light, i, ray, samples, share, sampler, room_,
                                sums);
            else
              add_in_scatter<3>(frame_, space_, light, i, ray, samples, share, sampler, room_,
                                sums);
          },
          frame_.scene.lights[std::size_t(i)]);
    };
    for_each_light_share(frame_, space_, ray, sampler, weights_, add);
  }

  const Frame& frame_;
  Tile& tile_;
  const Medium* medium_;
  const Space& space_;
  Watcher& watcher_;
  Vec3<F> camera_local_;
  PacketSums<F> sums_;
  WalkRoom<F> walk_room_;   ///< for one camera ray
  std::vector<F> weights_;  ///< of lights on one camera ray
  ShadowRoom room_;
};

template <Real F, class Watcher>
void render_tile(const Frame& frame, Tile& tile, Watcher& watcher) {
  with_space(frame.scene.media, [&](const Medium* medium, const auto& space) {
    TileKernel<F, std::remove_cvref_t<decltype(space)>, Watcher>(frame, tile, medium, space,
                                                                 watcher)
        .render();
  });
}

template <Real F>
void render_tile(const Frame& frame, Tile& tile) {
  if (frame.paths.max_depth > 1) return render_paths<F>(frame, tile);
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
