#pragma once
/// How a tile is rendered where light may scatter more than once. A lane holds a path: a camera ray
/// that is continued at random, and on every segment of which all lights are asked. When a path
/// ends, its sums go to its pixel and the lane takes the next path of the tile, so that lanes stay
/// in use; the order is that of the paths' numbers, whichever thread renders the tile.
#include <airlight/free_flight.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "render/background.h"
#include "render/camera_ray.h"
#include "render/light_shares.h"
#include "render/surface_light.h"

namespace airlight {

/// A packet of paths at their current segments.
template <Real F>
struct Paths {
  Vec3<F> origin;     ///< of the segment's ray  [m]
  Vec3<F> direction;  ///< unit length
  F t_from{F(0)};     ///< where the segment begins: behind the surface passed last  [m]
  Rgb<F> throughput;  ///< β: what light at the segment is multiplied by on its way to the camera
  F events{F(0)};     ///< scattering and bounces so far
  PathSampler<F> points{UInt<F>(0u), UInt<F>(0u), UInt<F>(0u)};
  Mask<F> alive = events < F(0);
  Mask<F> on_camera_ray = alive;  ///< no event so far
  Mask<F> via_surface =
      alive;  ///< the event next to the camera was on a surface, not in the medium

  void replace(Mask<F> where, Vec3<F> new_origin, Vec3<F> new_direction, F new_t_from,
               const Rgb<F>& new_throughput) noexcept {
    origin = select(where, new_origin, origin);
    direction = select(where, new_direction, direction);
    t_from = select(where, new_t_from, t_from);
    throughput = select(where, new_throughput, throughput);
  }
};

/// Is told what paths do; this one does not listen.
struct UnwatchedPaths {
  /// Paths are at the beginning of their segments.
  template <Real F>
  void begins(const Paths<F>&) const noexcept {}
  /// Light is gathered at a segment.
  template <Real F>
  void gathers(const Paths<F>&, const Estimate<F>&, Mask<F>) const noexcept {}
  /// Paths go on with this throughput, before chance ends some that carry little.
  template <Real F>
  void goes_on(const Paths<F>& /*before*/, const Rgb<F>& /*throughput*/, Mask<F> /*scatters*/,
               Mask<F> /*passes or bounces*/) const noexcept {}
};

/// What a packet of paths has gathered, of one light group.
template <Real F>
struct PathSums {
  Estimate<F> in_scatter;
  Rgb<F> surface;
};

template <Real F, class Space, class Watcher>
class PathKernel {
 public:
  PathKernel(const Frame& frame, Tile& tile, const Medium* medium, const Space& space,
             Watcher& watcher)
      : frame_(frame),
        tile_(tile),
        medium_(medium),
        space_(space),
        watcher_(watcher),
        glows_(std::ranges::any_of(frame.scene.media,
                                   [](const Medium& m) { return m.emission != Rgb<double>(); })),
        jobs_(std::uint64_t(tile.samples.count) * std::uint64_t(tile.rect.width) *
              std::uint64_t(tile.rect.height)),
        sums_(std::size_t(frame.layout.groups)),
        weights_(frame.scene.lights.size(), F(0)),
        holdout_light_(frame.layout.shadow ? std::size_t(frame.layout.groups) : 0),
        rows_(std::size_t(frame.layout.sums() + FilmLayout::added + frame.layout.features() -
                          frame.layout.holdouts())),
        features_(std::size_t(tile.rect.width * tile.rect.height * frame.layout.features())) {
    first_kept_.reserve(std::size_t(tile.rect.width * tile.rect.height));
    for_each_pixel([&](const FilmPixels& film) {
      const bool untouched = film.samples[0] + film.samples[film_block::pixels] == 0;
      first_kept_.push_back(untouched ? std::numeric_limits<std::uint32_t>::max() : 0);
    });
  }

  void render() noexcept {
    for (refill(); any(paths_.alive); refill()) {
      tile_.paths.vertices += std::popcount(bits<F>(paths_.alive));
      tile_.paths.offered += lanes<F>;
      watcher_.begins(paths_);
      const Mask<F> before = paths_.alive;
      segment();
      deposit(bits<F>(before) & ~bits<F>(paths_.alive));
    }
    const float* held = features_.data();
    for_each_pixel([&](const FilmPixels& film) {
      for (int row = 0; row < frame_.layout.features(); ++row, ++held)
        film.features[row * film_block::pixels] += *held;
    });
  }

 private:
  /// The pixel and the sample of a lane's path.
  struct Job {
    int x = 0, y = 0;  ///< from the tile's corner
    std::uint32_t sample = 0;
    int half = 0;
  };

  /// Calls visit(where its numbers are in the film) for every pixel of the tile, row by row.
  template <class Visit>
  void for_each_pixel(Visit&& visit) const noexcept {
    for (int y = 0; y < tile_.rect.height; ++y)
      for (int x = 0; x < tile_.rect.width; ++x)
        visit(tile_.film.at(tile_.rect.x0 + x, tile_.rect.y0 + y));
  }

  /// Gives idle lanes the next paths.
  void refill() noexcept {
    constexpr std::uint32_t every = (std::uint64_t(1) << lanes<F>)-1;
    const std::uint32_t idle = every & ~bits<F>(paths_.alive);
    if (!idle || next_ == jobs_) return;
    alignas(64) Scalar<F> px[lanes<F>] = {}, py[lanes<F>] = {};
    alignas(64) std::uint32_t hash[lanes<F>] = {}, sample[lanes<F>] = {}, ray[lanes<F>] = {};
    std::uint32_t fresh = 0;
    const std::uint64_t pixels = std::uint64_t(tile_.rect.width) * std::uint64_t(tile_.rect.height);
    for (int i = 0; i < lanes<F> && next_ < jobs_; ++i) {
      if (!((idle >> i) & 1u)) continue;
      const int pixel = int(next_ % pixels);
      Job& job = job_[std::size_t(i)];
      job.x = pixel % tile_.rect.width, job.y = pixel / tile_.rect.width;
      job.sample = tile_.samples.first + std::uint32_t(next_ / pixels);
      ray[i] = job.sample / frame_.samples_per_ray;
      job.half = half_of(frame_.halves_by_ray() ? ray[i] : job.sample);
      const int X = tile_.film.crop.x0 + tile_.rect.x0 + job.x;
      const int Y = tile_.film.crop.y0 + tile_.rect.y0 + job.y;
      px[i] = Scalar<F>(X) + Scalar<F>(0.5), py[i] = Scalar<F>(Y) + Scalar<F>(0.5);
      hash[i] = pixel_hash(frame_.seed, std::uint32_t(X), std::uint32_t(Y));
      sample[i] = job.sample;
      fresh |= 1u << i;
      ++next_;
    }
    const Mask<F> where = mask_from_bits<F>(fresh);
    F x = load<F>(px), y = load<F>(py);
    behind_ = select(where, background_at(frame_.scene, x, y), behind_);
    if (!frame_.through_centre) {
      const PathSampler<F> camera{load_bits<F>(hash), load_bits<F>(ray), UInt<F>(0u)};
      const Vec2<F> offset = filter_offset(frame_.filter, camera.two(0, stream::camera));
      x = x + offset.x, y = y + offset.y;
    }
    paths_.replace(where, Vec3<F>(frame_.camera.position), camera_direction(frame_.camera, x, y),
                   F(0), Rgb<F>(F(1)));
    paths_.events = select(where, F(0), paths_.events);
    paths_.points.pixel_hash = select_bits<F>(where, load_bits<F>(hash), paths_.points.pixel_hash);
    paths_.points.index = select_bits<F>(where, load_bits<F>(sample), paths_.points.index);
    paths_.points.vertex = select_bits<F>(where, UInt<F>(0u), paths_.points.vertex);
    paths_.alive = paths_.alive | where;
    paths_.on_camera_ray = paths_.on_camera_ray | where;
    paths_.via_surface = paths_.via_surface & !where;
    first_segment_ = where;
  }

  /// Gathers the light of a segment of every path and continues the paths.
  void segment() noexcept {
    const Mask<F> alive = paths_.alive;
    const Hit<F> hit =
        frame_.world.template closest<F>(paths_.origin, paths_.direction, paths_.t_from, alive);
    const Mask<F> found = hit.found & alive;
    MediumRay<F> ray;
    ray.t_max = F(0);
    ray.active = ray.t_max > F(0);
    const LocalRay<F> local{space_.point(paths_.origin), space_.vector(paths_.direction)};
    auto inside = stretches_of(medium_, space_, local);
    inside.begin_at(paths_.t_from);
    if (medium_) {
      const F t_end = select(alive, select(found, hit.t, F(far_away)), F(0));
      ray = medium_ray(CameraRay<F>{paths_.origin, paths_.direction, t_end}, local, inside.hull());
      ray.dimmed = paths_.throughput;
    }
    const SurfaceLight<F, Space, PathSampler<F>> surfaces(frame_, medium_, space_, paths_.points,
                                                          Bundle::loose);
    if (glows_)
      add(Frame::ungrouped,
          paths_.throughput * inside.emitted(ray.t_enter, ray.t_enter + ray.t_max),
          !paths_.via_surface, alive);
    Crossing<F> at{};
    if (any(found)) at = surfaces.crossing(hit, found, paths_.origin, paths_.direction);

    // Media in pieces take three channels in any colour: it is their geometry that costs.
    if constexpr (!InPieces<Space>)
      if (!medium_ || medium_->is_grey()) return segment<1>(hit, found, inside, ray, at, surfaces);
    segment<3>(hit, found, inside, ray, at, surfaces);
  }

  template <int channels, class Inside>
  void segment(const Hit<F>& hit, Mask<F> found, const Inside& inside, const MediumRay<F>& ray,
               const Crossing<F>& at,
               const SurfaceLight<F, Space, PathSampler<F>>& surfaces) noexcept {
    const auto flight = free_flight<channels>(inside, ray.t_enter, ray.t_max, paths_.throughput);
    const Rgb<F> dimmed = flight.dimmed();
    const Mask<F> from_fog = !(paths_.on_camera_ray | paths_.via_surface);
    const Mask<F> last = paths_.events + F(1) >= F(Scalar<F>(frame_.paths.max_depth));

    background(at, dimmed, from_fog, found, surfaces);
    if (any(first_segment_)) describe(hit, found, at);
    Continued on{flight.draw(paths_.points.one(0, stream::flight)), F(0) > F(0), F(0)};
    if (any(ray.active)) in_scatter<channels>(ray, on);
    const Mask<F> reflects = found & (at.albedo.r + at.albedo.g + at.albedo.b > F(0));
    if (any(reflects)) surface_light(at, dimmed, from_fog, last, reflects, surfaces);
    go_on(flight, on, inside, ray, hit, at, last);
  }

  /// What is behind everything. A picture there is seen by camera rays only: what it sends
  /// elsewhere is not known, and `background` stands for it.
  void background(const Crossing<F>& at, const Rgb<F>& dimmed, Mask<F> from_fog, Mask<F> found,
                  const SurfaceLight<F, Space, PathSampler<F>>& surfaces) noexcept {
    const Mask<F> straight = paths_.alive & paths_.on_camera_ray;
    if (any(straight)) {
      const Rgb<F> passed = dimmed * select(found, at.uncovered, F(1));
      transmittance_ = select(straight, transmittance_ + passed, transmittance_);
      Mask<F> open = straight;
      if (const Mask<F> held = straight & found & (at.uncovered > F(0));
          frame_.layout.shadow && any(held)) {
        holdouts_ += surfaces.holdouts(at, passed, behind_, {0, 1}, held, holdout_light_);
        open = open & !held;
      }
      add(Frame::ungrouped, passed * behind_, from_fog, open);
    }
    if (frame_.scene.background != Rgb<double>())
      add(Frame::ungrouped, dimmed * Rgb<F>(frame_.scene.background), from_fog,
          paths_.alive & !paths_.on_camera_ray & !found);
  }

  /// Where a path scatters next.
  struct Continued {
    F t;  ///< from the start of the segment's part in the medium, or beyond its end  [m]
    Mask<F> from_sample;  ///< t comes from a sample of the estimator, else from a free flight
    F pdf;                ///< of such a t in that part  [1/m]
  };

  /// The light of every light scattered along the segment, by the estimator with one sample. A path
  /// goes on from the sample of a light drawn blindly, or, where samples ask one light each, of the
  /// light asked, if that is one to go on from.
  template <int channels>
  void in_scatter(const MediumRay<F>& ray, Continued& on) noexcept {
    const auto& sampled = std::get<Sampled>(frame_.estimator);
    const int sources = frame_.paths.sample_sources;
    F chosen(0);  // its whole part is the light from whose sample the path goes on
    if (sources > 1) chosen = paths_.points.one(0, stream::light) * F(Scalar<F>(sources));
    int source = 0;
    const auto ask = [&](int i, const LightShare<F>* share) {
      const bool goes_on = sources > 0 && paths_go_on_from(frame_.scene.lights[std::size_t(i)]);
      const auto watch = [&](const WatchedSample<F>& sample) {
        if (!goes_on) return;
        const Mask<F> mine = share ? sample.asked : ray.active & (chosen >= F(Scalar<F>(source)));
        on.t = select(mine, sample.t - ray.t_enter, on.t);
        on.pdf = select(mine, share ? sample.pdf * share->boost() : sample.pdf, on.pdf);
        on.from_sample = on.from_sample | mine;
        ++source;
      };
      static_assert(half_of(0) == 0);
      Halves<F> sums;
      std::visit(
          [&](const auto& light) {
            sampled.add<channels>(*medium_, space_, light, i, ray, {0, 1}, false, paths_.points,
                                  frame_.world, sums, watch, share);
          },
          frame_.scene.lights[std::size_t(i)]);
      add(i, sums[0], ray.active);
    };
    for_each_light_share(frame_, space_, ray, paths_.points, weights_, ask);
  }

  /// The light that a surface sends back along the segment.
  void surface_light(const Crossing<F>& at, const Rgb<F>& dimmed, Mask<F> from_fog, Mask<F> last,
                     Mask<F> reflects,
                     const SurfaceLight<F, Space, PathSampler<F>>& surfaces) noexcept {
    // The ambient light stands for what is not followed.
    if (frame_.scene.ambient != Rgb<double>())
      add(Frame::ungrouped, dimmed * at.albedo * Rgb<F>(frame_.scene.ambient), from_fog,
          reflects & last);
    surfaces.reflect(at, dimmed, {0, 1}, reflects, [&](int light, const Shadowed<F>& reflected) {
      if (frame_.paths.surface == SurfaceSums::split)
        return add(frame_.light_group[std::size_t(light)], reflected.occluded, from_fog, reflects);
      const Estimate<F> sums = std::visit(
          [&](const Form auto& make) {
            return make(reflected.unoccluded, reflected.occluded, reflected.unoccluded);
          },
          std::get<Sampled>(frame_.estimator).form);
      add(light, sums, reflects);
    });
  }

  /// Draws whether a path scatters, bounces, passes or ends, and where it goes from there.
  template <class Flight, class Inside>
  void go_on(const Flight& flight, const Continued& on, const Inside& inside,
             const MediumRay<F>& ray, const Hit<F>& hit, const Crossing<F>& at,
             Mask<F> last) noexcept {
    const PathSampler<F>& points = paths_.points;
    const Mask<F> alive = paths_.alive;
    const auto weight = [](const Rgb<F>& c) { return c.r + c.g + c.b; };
    const Rgb<F> albedo = select(last, Rgb<F>(), at.albedo);
    Mask<F> beyond = alive & (weight(at.filter) + weight(albedo) > F(0));

    Mask<F> scatters = alive & !last & ray.active;
    Rgb<F> scattered, arrived;
    if (frame_.paths.sample_sources > 0) {
      // Every segment with a sample scatters that does not end at something to bounce off or to
      // pass.
      const F chance = select(beyond, flight.chance_to_scatter(), F(1));
      const Mask<F> drawn = points.one(0, stream::flight) < chance;
      scatters =
          scatters & ((on.from_sample & drawn) | ((!on.from_sample) & (on.t < flight.length)));
      scattered =
          select(on.from_sample, flight.scattered(on.t, on.pdf * chance), flight.scattered(on.t));
      arrived = flight.arrived();
    } else {
      scatters = scatters & (on.t < flight.length);
      scattered = flight.scattered(on.t);
      arrived = flight.arrived();
    }
    arrived = select(last, flight.dimmed(), arrived);
    beyond = beyond & !scatters;

    // Off the surface or through it, in proportion to what the path carries of each.
    const Rgb<F> back = arrived * albedo, through = arrived * at.filter;
    const F both = weight(back) + weight(through);
    const F chance_back = weight(back) / select(both > F(0), both, F(1));
    const Mask<F> turns = points.one(0, stream::side) < chance_back;
    Mask<F> reflected = beyond & turns;
    const Mask<F> passes = beyond & !turns & (weight(through) > F(0));

    const Vec2<F> u = points.two(0, stream::direction);
    const Vec3<F> off = cosine_hemisphere(at.normal, u);
    reflected = reflected & (dot(off, at.geometric) > F(0));
    const Mask<F> event = scatters | reflected;
    const auto part_of = [](const Rgb<F>& c, F chance) {
      return c * (F(1) / select(chance > F(0), chance, F(1)));
    };
    const Rgb<F> bounced = part_of(back, chance_back),
                 passed = part_of(through, F(1) - chance_back);
    watcher_.goes_on(paths_, select(scatters, scattered, select(passes, passed, bounced)), scatters,
                     passes | reflected);
    if (any(scatters)) {
      const F t = ray.t_enter + on.t;
      const Vec3<F> point = ray.origin + ray.direction * t;
      const Vec3<F> onward = inside.onward(t, paths_.direction, u);
      paths_.replace(scatters, point, normalize(onward), F(0), scattered);
    }
    if (any(reflected)) paths_.replace(reflected, at.above, off, F(0), bounced);
    if (any(passes)) paths_.replace(passes, paths_.origin, paths_.direction, hit.t, passed);
    paths_.via_surface = paths_.via_surface | (reflected & paths_.on_camera_ray);
    paths_.on_camera_ray = paths_.on_camera_ray & !event;
    paths_.events = select(event, paths_.events + F(1), paths_.events);
    paths_.alive = (event | passes) & survives_roulette(paths_.throughput,
                                                        F(Scalar<F>(frame_.paths.roulette_below)),
                                                        points.one(0, stream::roulette));
    paths_.points.vertex = paths_.points.vertex + UInt<F>(1u);
    first_segment_ = first_segment_ & !first_segment_;
  }

  /// Adds what is not asked of a light: to the in-scatter of the pixel or to its surfaces.
  void add(int group, const Rgb<F>& light, Mask<F> to_in_scatter, Mask<F> where) noexcept {
    watcher_.gathers(paths_, Estimate<F>{light, {}, {}, {}}, where);
    PathSums<F>& sums = sums_[std::size_t(group)];
    Rgb<F>&fog = sums.in_scatter.plain, &surface = sums.surface;
    fog = select(where & to_in_scatter, fog + light, fog);
    surface = select(where & !to_in_scatter, surface + light, surface);
  }

  /// Adds an estimate of light from a light. What surfaces reflect into the camera stays a plain
  /// sum beside the in-scatter, unless all is to be one ratio.
  void add(int light, const Estimate<F>& sums, Mask<F> where) noexcept {
    watcher_.gathers(paths_, sums, where);
    PathSums<F>& group = sums_[std::size_t(frame_.light_group[std::size_t(light)])];
    const bool split = frame_.paths.surface == SurfaceSums::split;
    const Mask<F> fog = split ? where & !paths_.via_surface : where;
    const auto gather = [&](Rgb<F>& sum, const Rgb<F>& part) {
      sum = select(fog, sum + part, sum);
    };
    gather(group.in_scatter.plain, sums.plain);
    gather(group.in_scatter.analytic, sums.analytic);
    gather(group.in_scatter.occluded, sums.occluded);
    gather(group.in_scatter.unoccluded, sums.unoccluded);
    if (split && any(where & paths_.via_surface))
      group.surface = select(where & paths_.via_surface, group.surface + sums.plain + sums.occluded,
                             group.surface);
  }

  /// Notes what the camera sees first.
  void describe(const Hit<F>& hit, Mask<F> found, const Crossing<F>& at) noexcept {
    const auto note = [&](auto& noted, const auto& seen, const auto& none) {
      noted = select(first_segment_, select(found, seen, none), noted);
    };
    note(albedo_, at.albedo, Rgb<F>());
    note(normal_, at.normal, Vec3<F>());
    note(depth_, hit.t, F(0));
    note(object_, at.object, F(0));
  }

  /// Adds the sums of the paths that have ended to the film and sets them to zero.
  void deposit(std::uint32_t ended) noexcept {
    if (!ended) return;
    const FilmLayout& layout = frame_.layout;
    std::size_t row = 0;
    F poison(0);  // stays zero but where a number is infinite or none
    const Mask<F> done = mask_from_bits<F>(ended);
    const auto take = [&](F& sum) {
      poison = fma(sum, F(0), poison);
      store(sum, rows_[row++].data());
      sum = select(done, F(0), sum);
    };
    const auto colour = [&](Rgb<F>& c) { take(c.r), take(c.g), take(c.b); };
    for (PathSums<F>& group : sums_) {
      if (layout.plain) colour(group.in_scatter.plain);
      if (layout.ratio)
        colour(group.in_scatter.analytic), colour(group.in_scatter.occluded),
            colour(group.in_scatter.unoccluded);
      colour(group.surface);
    }
    if (layout.shadow) colour(holdouts_.plate);
    colour(transmittance_), colour(albedo_), take(normal_.x), take(normal_.y), take(normal_.z);
    if (layout.shadow) colour(holdouts_.seen);
    for (auto& [lit, was_lit] : holdout_light_) colour(lit), colour(was_lit);
    const std::uint32_t good = bits<F>(poison == F(0));
    for (int i = 0; i < lanes<F>; ++i)
      if ((ended >> i) & 1u) {
        if ((good >> i) & 1u)
          deposit_lane(i);
        else
          ++tile_.rejected;
      }
  }

  void deposit_lane(int i) noexcept {
    constexpr int width = film_block::pixels;
    const FilmLayout& layout = frame_.layout;
    const Job& job = job_[std::size_t(i)];
    const auto pixel = std::size_t(job.y * tile_.rect.width + job.x);
    const FilmPixels film = tile_.film.at(tile_.rect.x0 + job.x, tile_.rect.y0 + job.y);
    float* const features = &features_[pixel * std::size_t(layout.features())];
    const int sums = layout.sums(), lane_index = i;
    const auto value = [&](int row) { return rows_[std::size_t(row)][std::size_t(lane_index)]; };
    for (int row = 0; row < sums; ++row) film.sums[row * width] += double(value(row));
    for (int row = 0; row < FilmLayout::added; ++row) features[row] += float(value(sums + row));
    for (int row = layout.holdouts(); row < layout.features(); ++row)
      features[row] += float(value(sums + FilmLayout::added + row - layout.holdouts()));
    if (job.half == 1)
      for (int g = 0; g < layout.groups; ++g)
        for (int k = 0; k < layout.estimate(); ++k)
          features[layout.second_half(g) + k] += float(value(layout.in_scatter(g) + k));
    if (job.sample < first_kept_[pixel]) {
      first_kept_[pixel] = job.sample;
      features[FilmLayout::depth] = float(lane(depth_, i));
      features[FilmLayout::object] = float(lane(object_, i));
    }
    ++film.samples[job.half * width];
  }

  const Frame& frame_;
  Tile& tile_;
  const Medium* medium_;
  const Space& space_;
  Watcher& watcher_;
  bool glows_;                     ///< whether any medium emits light
  std::uint64_t jobs_, next_ = 0;  ///< paths of the tile; of those, begun
  std::array<Job, std::size_t(lanes<F>)> job_;
  Paths<F> paths_;
  Mask<F> first_segment_ = paths_.alive;
  std::vector<PathSums<F>> sums_;  ///< by light group
  std::vector<F> weights_;         ///< of lights on one segment
  Rgb<F> behind_;                  ///< every path's pixel of the background
  Rgb<F> transmittance_, albedo_;
  Vec3<F> normal_;
  HoldoutSums<F> holdouts_;
  std::vector<HoldoutLight<F>> holdout_light_;  ///< by light group
  F depth_{F(0)}, object_{F(0)};
  std::vector<std::array<Scalar<F>, std::size_t(lanes<F>)>>
      rows_;  ///< sums on their way to the film
  /// The film's float rows of every pixel of the tile: added one by one, the floats of all passes
  /// would drift.
  std::vector<float> features_;
  std::vector<std::uint32_t> first_kept_;  ///< by pixel: the first sample there; 0: it is older
};

template <Real F, class Watcher>
void render_paths(const Frame& frame, Tile& tile, Watcher& watcher) {
  with_space(frame.scene.media, [&](const Medium* medium, const auto& space) {
    using Space = std::remove_cvref_t<decltype(space)>;
    PathKernel<F, Space, Watcher>(frame, tile, medium, space, watcher).render();
  });
}

template <Real F>
void render_paths(const Frame& frame, Tile& tile) {
  UnwatchedPaths nobody;
  render_paths<F>(frame, tile, nobody);
}

}  // namespace airlight
