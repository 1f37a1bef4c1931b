#include "render/probe.h"

#include <fmt/format.h>

#include "error.h"
#include "render/prepare.h"
#include "render/tile_kernel.h"

namespace airlight {
namespace {

constexpr int step_count = 512;

/// Keeps every camera ray. Room for all of them is made before the kernel runs, which must not
/// throw.
struct RayKeeper {
  std::vector<ProbedRay> rays;
  std::vector<MediumRay<double>> medium_rays;  ///< t_max = 0 where a ray misses the medium

  explicit RayKeeper(std::size_t most) {
    rays.reserve(most);
    medium_rays.reserve(most);
  }

  template <Real F, class Space>
  void camera_ray(const SurfaceWalk<F, Space>& walk, Vec3<F> direction,
                  SampleRange samples) noexcept {
    ProbedRay ray;
    ray.direction = direction;
    ray.sample_count = samples.count;
    if (walk.object > 0) {
      ray.hit = walk.depth;
      ray.object = std::size_t(walk.object) - 1;
    }
    if (walk.t_end < far_away) ray.end = walk.t_end;
    ray.through = walk.through;
    for (const Rgb<F>& group : walk.radiance) ray.surface += group;
    ray.surface += walk.plate();
    ray.emission = walk.emission;
    rays.push_back(ray);
    medium_rays.emplace_back().t_max = 0;
  }

  template <Real F>
  void medium_ray(const MediumRay<F>& ray) noexcept {
    medium_rays.back() = ray;
    rays.back().t_enter = ray.t_enter;
    rays.back().t_exit = ray.t_enter + ray.t_max;
  }
};

/// What the kernel does with one ray and one light, done once more with every step kept.
template <int channels, class Space, class L>
class LightProbe {
 public:
  LightProbe(const Frame& frame, const Space& space, const Sampler<double>& sampler,
             const MediumRay<double>& ray, const L& light, int light_index)
      : frame_(frame),
        medium_(frame.scene.media[0]),
        space_(space),
        sampler_(sampler),
        whole_ray_(ray),
        light_(light),
        light_index_(light_index),
        toward_(Sampled::toward<double>(light, light_index, ray.index, sampler)),
        lit_(lit_part(light, medium_, space, ray)),
        ray_(lit_.ray),
        section_(
            section_along<double, channels>(medium_, lit_.space, ray_, space.vector(toward_))) {
    section_.trace_way_out();
  }

  ProbedLight operator()(SampleRange samples, const LightShare<double>* share) const {
    ProbedLight result;
    result.light = std::size_t(light_index_);
    result.toward = toward_;
    result.in_pieces = InPieces<Space>;
    result.strength = strength_along<Space>(medium_, light_.irradiance) *
                      phase_along<Space>(medium_, dot(toward_, ray_.direction));
    if (!ray_.active) return result;  // a beam that passes by
    result.transmittance_integral = ray_.dimmed * to_rgb(section_.integral);
    add_nodes(result);
    add_steps(result);
    add_samples(result, samples, share);
    return result;
  }

 private:
  void add_nodes(ProbedLight& result) const {
    if constexpr (InPieces<Space>) {
      const std::vector<double> lengths = piece_lengths();
      const Rgb<double> before =
          space_.stretches(whole_ray_.entry, medium_).depth(ray_.t_enter - whole_ray_.t_enter);
      for (int i = 0; i < section_.pieces.count; ++i) {
        const double begin = ray_.t_enter + section_.pieces.t[i];
        const double end = ray_.t_enter + section_.pieces.t[i + 1];
        const std::size_t k = 2 * std::size_t(i);
        if (i == 0 || !continues(i))
          result.nodes.push_back({begin, lengths[k], before + depths(section_.pieces.begin[i])});
        result.nodes.push_back({end, lengths[k + 1], before + depths(section_.pieces.end[i])});
      }
    } else {
      for (int i = 0; i <= section_.way.segments; ++i) {
        // Where fewer lines touch the envelope than there are faces, segments have no length.
        if (i > 0 && section_.way.t[i] <= section_.way.t[i - 1]) continue;
        const double length = section_.way.length[i];
        const double t = ray_.t_enter + section_.way.t[i];
        const double whole = ray_.t_enter - whole_ray_.t_enter + length;  // from the medium's edge
        result.nodes.push_back({t, whole, medium_.sigma_t * whole});
      }
    }
  }

  /// Whether a piece begins at the depth where the one before ended, but for rounding.
  bool continues(int i) const requires InPieces<Space> {
    const Rgb<double> before = depths(section_.pieces.end[i - 1]);
    const Rgb<double> after = depths(section_.pieces.begin[i]);
    for (int c = 0; c < 3; ++c)
      if (std::abs(before[c] - after[c]) > 1e-9 * (1 + before[c])) return false;
    return true;
  }

  template <class Depths>
  Rgb<double> depths(const Depths& x) const {
    Channels<double, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = section_.pieces.depth_of(x, c);
    return to_rgb(result);
  }

  /// Of both ends of every piece: the depths if every medium's extinction were 1.  [m]
  std::vector<double> piece_lengths() const requires InPieces<Space> {
    std::vector<Medium> media = frame_.scene.media;
    for (Medium& medium : media) medium.sigma_t = medium.sigma_s = Rgb<double>(1.);
    std::vector<double> lengths;
    with_space(media, [&](const Medium* first, const auto& space) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(space)>, Space>) {
        const auto lit = lit_part(light_, *first, space, whole_ray_);
        auto section = section_along<double, 1>(*first, lit.space, lit.ray, toward_);
        section.trace_way_out();
        const double before =
            space.stretches(whole_ray_.entry, *first).depth(lit.ray.t_enter - whole_ray_.t_enter).r;
        for (int i = 0; i < section.pieces.count; ++i) {
          lengths.push_back(before + section.pieces.begin[i][0]);
          lengths.push_back(before + section.pieces.end[i][0]);
        }
      }
    });
    return lengths;
  }

  void add_steps(ProbedLight& result) const {
    const double width = ray_.t_max / step_count;
    for (int i = 0; i < step_count; ++i) {
      const double t = (i + 0.5) * width;
      const auto at = section_.at(t);
      const double along = ray_.t_enter + t;
      ProbedStep step{along, pdf(t, at), ray_.dimmed * to_rgb(section_.transmittance(at)), {}};
      const Vec3<double> from = ray_.origin + ray_.direction * along;
      step.visibility =
          frame_.world.transmit(from, toward_, light_.reach(from), light_index_, true);
      if (ray_.filtered)
        step.visibility *=
            frame_.world.transmit(ray_.origin, ray_.direction, along, no_light, true);
      result.steps.push_back(step);
      const Rgb<double>& seen = step.visibility;
      if (!(seen.r > 0 || seen.g > 0 || seen.b > 0)) continue;
      const double begin = ray_.t_enter + i * width, end = begin + width;
      if (!result.lit.empty() && begin - result.lit.back().second < width / 2)
        result.lit.back().second = end;
      else
        result.lit.emplace_back(begin, end);
    }
  }

  double pdf(double t, const typename Section<double, channels, Space>::Point& at) const {
    const auto* sampled = std::get_if<Sampled>(&frame_.estimator);
    if (!sampled) return 0;
    return std::visit(
        [&](const Placement auto& place) {
          return place
              .on(section_,
                  sampled->template carried<channels, Space>(medium_, light_, ray_.dimmed))
              .pdf(t, at);
        },
        sampled->placement);
  }

  void add_samples(ProbedLight& result, SampleRange samples,
                   const LightShare<double>* share) const {
    Halves<double> sums;
    ShadowRoom room = shadow_room(frame_);
    add_in_scatter<channels>(
        frame_, space_, light_, light_index_, whole_ray_, samples, share, sampler_, room, sums,
        [&](const WatchedSample<double>& s) {
          result.samples.push_back({s.index, s.t, s.pdf, s.weight, s.visibility});
        });
    sums[0] += sums[1];
    result.mean = sums[0] * (1. / samples.count);
  }

  const Frame& frame_;
  const Medium& medium_;
  const Space& space_;
  const Sampler<double>& sampler_;
  const MediumRay<double>& whole_ray_;
  const L& light_;
  int light_index_;
  Vec3<double> toward_;
  using Lit =
      decltype(lit_part(std::declval<const L&>(), std::declval<const Medium&>(),
                        std::declval<const Space&>(), std::declval<const MediumRay<double>&>()));
  Lit lit_;
  const MediumRay<double>& ray_;  ///< the part of it that the light reaches
  Section<double, channels, std::remove_cvref_t<decltype(lit_.space)>> section_;
};

void probe_lights(const Frame& frame, const Sampler<double>& sampler,
                  const MediumRay<double>& medium_ray, ProbedRay& ray, SampleRange samples) {
  const auto probe_light = [&]<int channels>(const auto& space, const auto& light, int index,
                                             const LightShare<double>* share) {
    LightProbe<channels, std::remove_cvref_t<decltype(space)>, std::remove_cvref_t<decltype(light)>>
        one(frame, space, sampler, medium_ray, light, index);
    ray.lights.push_back(one(samples, share));
  };
  std::vector<double> weights(frame.scene.lights.size());
  with_space(frame.scene.media, [&](const Medium* medium, const auto& space) {
    if (!medium) return;
    const auto probe = [&](int i, const LightShare<double>* share) {
      std::visit(
          [&](const auto& light) {
            if (is_grey(*medium, space))
              probe_light.template operator()<1>(space, light, i, share);
            else
              probe_light.template operator()<3>(space, light, i, share);
          },
          frame.scene.lights[std::size_t(i)]);
    };
    for_each_light_share(frame, space, medium_ray, sampler, weights, probe);
  });
}

constexpr std::int64_t most_probed = 1 << 20;

}  // namespace

Probe probe(const Scene& scene, const RenderSettings& settings, int x, int y) {
  const Resolution size = scene.resolution;
  if (x < 0 || y < 0 || x >= size.width || y >= size.height)
    throw Error(fmt::format("pixel {},{} is not in the picture; accepted: 0,0 to {},{}", x, y,
                            size.width - 1, size.height - 1));
  RenderSettings in_double = settings;
  in_double.isa = InstructionSet::reference;
  in_double.max_depth = 1;
  check_settings(scene, settings);
  if (settings.spp > most_probed)
    throw Error(fmt::format("render.spp = {} are too many to tell one by one; accepted: up to {}",
                            settings.spp, most_probed));
  const World world(scene, settings.visibility);
  const Prepared prepared = prepare(scene, world, in_double);

  const Frame& frame = prepared.frame;
  Film film(size, {x, y, 1, 1}, frame.layout, light_group_names(scene));
  Tile tile{{0, 0, 1, 1}, prepared.samples, film};
  RayKeeper keeper(prepared.samples.count / frame.samples_per_ray + 2);
  render_tile<double>(frame, tile, keeper);

  Probe result;
  result.x = x, result.y = y;
  result.estimator = settings.estimator;
  result.max_depth = int(settings.max_depth);
  result.rays = std::move(keeper.rays);
  for (int group = 0; group < frame.layout.groups; ++group) {
    const PixelSums sums = film.pixel(0, group);
    result.mean += mean_estimate(sums);
    result.in_scatter += mean_estimate(sums).radiance();
    result.surface += sums.visible() * (1 / sums.sample_count());
  }
  result.radiance = result.in_scatter + result.surface;

  const Sampler<double> sampler{pixel_hash(frame.seed, std::uint32_t(x), std::uint32_t(y))};
  SampleRange samples{prepared.samples.first, 0};
  for (std::size_t i = 0; i < result.rays.size(); ++i) {
    ProbedRay& ray = result.rays[i];
    samples.count = ray.sample_count;
    ray.origin = frame.camera.position;
    if (ray.t_enter) probe_lights(frame, sampler, keeper.medium_rays[i], ray, samples);
    samples.first += samples.count;
  }
  return result;
}

}  // namespace airlight
