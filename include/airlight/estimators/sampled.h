#pragma once
#include <algorithm>

#include "../estimator.h"
#include "../forms.h"
#include "../light_share.h"
#include "../lit_part.h"
#include "../math/sort.h"
#include "../math/warp.h"
#include "../never_arrives.h"
#include "../placements.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What `Sampled` tells a watcher of each sample.
template <Real F>
struct WatchedSample {
  std::uint32_t index;
  F t;                ///< from the origin of the ray  [m]
  F pdf;              ///< [1/m]
  Rgb<F> weight;      ///< transmittance over pdf  [m]
  Rgb<F> visibility;  ///< 0 to 1
  Mask<F> asked;      ///< the lanes whose sample asks this light
};

/// Samples along the camera ray, each asking once whether light arrives: any placement with any
/// form, the stochastic estimators of Velinov 2021 section 3 and more.
struct Sampled {
  Placements placement = WholeVolume{};
  Forms form = Ratio{};
  /// Intersects the shape at every sample instead of finding the way out once a ray: the plain
  /// march that the paper compares with.
  bool intersect_every_step = false;
  /// Paths go on from the samples: all channels must then be drawn, also those that the light
  /// lacks.
  bool paths_go_on = false;

  static constexpr auto name = "sampled";
  static constexpr auto meaning = "samples along the camera ray: a placement and a form";

  const char* unsupported(const Medium& medium, const Lights& light) const noexcept {
    if (const char* reason = never_arrives(medium, light)) return reason;
    if (intersect_every_step && !(std::holds_alternative<Equidistant>(placement) &&
                                  std::holds_alternative<MonteCarlo>(form)))
      return "edges = \"per_step\" is the plain march: it goes with rm (equidistant+monte_carlo) "
             "only";
    return nullptr;
  }

  /// A sample before its shadow ray.
  template <Real F, class Point>
  struct Drawn {
    Mask<F> second;  ///< the lanes whose sample belongs to the second half
    F t, along;      ///< from the entry, and from the camera  [m]
    Point at;        ///< what the section knows of it
    F reach;         ///< from the sample to where light begins  [m]
    Mask<F> asked;   ///< the lanes whose sample asks this light
    Rgb<F> weight;   ///< transmittance over density, of lanes that ask  [m]
    Vec3<F> from;
  };

  /// The samples of one light on the lit part of one camera ray, in the order of what happens to
  /// each: drawn, then asked for the light that arrives.
  template <Real F, ParallelLight L, class Section, PlacedOn<Section> Placed>
  struct OnRay {
    const MediumRay<F>& ray;
    const L& light;
    int light_index;
    Vec3<F> toward;  ///< the light
    const Section& section;
    const Placed& placed;
    const LightShare<F>* share;  ///< null: all samples ask the light
    bool intersect_every_step;

    using Sample = Drawn<F, typename Section::Point>;

    Sample draw(UInt<F> bits) const noexcept {
      Sample d;
      d.second = is_odd<F>(bits);
      d.asked = ray.active;
      F u = unit_interval<F>(bits);
      if (share) {
        d.asked = d.asked & share->takes(u);
        if (!any(d.asked)) return d;
      }
      d.t = placed.sample(u);
      d.along = ray.t_enter + d.t;
      d.from = ray.origin + ray.direction * d.along;
      d.reach = light.reach(d.from);
      d.at = intersect_every_step ? section.intersected(d.t, d.reach) : section.at(d.t);
      d.weight = to_rgb<F>(placed.weights(d.t, d.at));
      if (share) d.weight = d.weight * select(d.asked, share->boost(), F(0));
      return d;
    }

    /// What arrives of the light that is sent to a sample and on to the camera, 0 to 1.
    template <AnswersVisibility<F> W>
    Rgb<F> visibility(const Sample& d, const W& world) const noexcept {
      Rgb<F> visible = world.transmit(d.from, toward, d.reach, light_index, d.asked);
      if (ray.filtered)
        visible *= world.transmit(ray.origin, ray.direction, d.along, no_light, d.asked);
      return visible;
    }

    WatchedSample<F> watched(std::uint32_t index, const Sample& d,
                             const Rgb<F>& visible) const noexcept {
      const F pdf = placed.pdf(d.t, d.at);
      return {index,   d.along, share ? pdf / share->boost() : pdf, d.weight * ray.dimmed,
              visible, d.asked};
    }
  };

  /// Weights of samples, and of what of them arrives, summed in halves.
  template <Real F>
  struct HalvedWeights {
    int half;  ///< that all samples belong to, or −1 where halves take turns
    std::array<Rgb<F>, 2> occluded{}, unoccluded{};

    template <class Sample>
    void add(const Sample& d, const Rgb<F>& visible) noexcept {
      const Rgb<F> none, sent = select(d.asked, d.weight, none), arrived = d.weight * visible;
      if (half >= 0) {
        occluded[half] += arrived, unoccluded[half] += sent;
      } else {
        occluded[0] += select(d.second, none, arrived);
        occluded[1] += select(d.second, arrived, none);
        unoccluded[0] += select(d.second, none, sent);
        unoccluded[1] += select(d.second, sent, none);
      }
    }

    /// How many of the samples belong to each half.
    std::array<std::uint32_t, 2> counts(SampleRange samples) const noexcept {
      std::array<std::uint32_t, 2> count{};
      for (std::uint32_t i = 0; i < samples.count; ++i)
        ++count[std::size_t(half < 0 ? half_of(samples.first + i) : half)];
      return count;
    }
  };

  /// Room for a sample that will be drawn: zeros would be written for nothing.
  template <class Sample>
  union Later {
    Sample sample;
    Later() noexcept {}
  };

  /// Samples are drawn a few at a time: each is one long chain of dependent steps, and those of
  /// several overlap in the processor. In lanes they are then taken in order along the ray:
  /// neighbouring pixels ask for visibility at neighbouring points, which Embree answers in two
  /// thirds of the time.
  static constexpr int drawn_ahead = 16;

  /// Random bits of `count` samples, the lowest of which tells the sample's half: one for all, or
  /// −1 where halves take turns.
  template <Real F, class Stream>
  static void random_bits(const Stream& distances, std::uint32_t first, int count, int half,
                          UInt<F>* bits) noexcept {
    for (int k = 0; k < count; ++k) {
      const std::uint32_t i = first + std::uint32_t(k);
      bits[k] =
          (distances.bits(i) & UInt<F>(~1u)) | UInt<F>(std::uint32_t(half < 0 ? half_of(i) : half));
    }
    if (lanes<F> == 1 || count == 1) return;
    for (int k = count; k < drawn_ahead; ++k) bits[k] = UInt<F>(~0u);  // come last
    if (count <= 4)
      sort_lanes<4>(bits);
    else if (count <= 8)
      sort_lanes<8>(bits);
    else
      sort_lanes<drawn_ahead>(bits);
  }

  /// Draws all samples and hands them on, use(i, drawn), a few at a time.
  template <Real F, class On, class Stream, class Use>
  static void for_each_drawn(const On& on_ray, SampleRange samples, int half, const Stream& numbers,
                             Use&& use) noexcept {
    const std::uint32_t end = samples.first + samples.count;
    for (std::uint32_t i = samples.first; i < end; i += drawn_ahead) {
      const int n = int(std::min(std::uint32_t(drawn_ahead), end - i));
      UInt<F> bits[drawn_ahead];
      random_bits<F>(numbers, i, n, half, bits);
      Later<typename On::Sample> drawn[drawn_ahead];
      for (int k = 0; k < n; ++k) drawn[k].sample = on_ray.draw(bits[k]);
      for (int k = 0; k < n; ++k) use(i + std::uint32_t(k), drawn[k].sample);
    }
  }

  /// Where light comes from for a camera ray: a disc gives every ray a direction of its own, for
  /// which all forms are exact.
  template <Real F, ParallelLight L, DrawsPoints<F> Points>
  static Vec3<F> toward(const L& light, int light_index, std::uint32_t ray,
                        const Points& sampler) noexcept {
    const Vec3<F> centre(light.toward());
    if (!(light.angular_diameter > 0)) return centre;
    return uniform_cap(centre, F(Scalar<F>(light.cap_height())),
                       sampler.two(ray, stream::disc(light_index)));
  }

  /// What a metre of the medium scatters, but for a factor that all channels share: it decides
  /// between them.
  template <int channels, class Space, Real F, ParallelLight L>
  Channels<F, channels> carried(const Medium& medium, const L& light,
                                const Rgb<F>& dimmed) const noexcept {
    const Rgb<double> strength =
        strength_along<Space>(medium, paths_go_on ? Rgb<double>(1.) : light.irradiance);
    Channels<F, channels> result;
    for (int c = 0; c < channels; ++c) result[c] = F(Scalar<F>(strength[c])) * dimmed[c];
    return result;
  }

  /// The in-scatter of a ray if nothing stood in the light's way, as the mean of its channels: a
  /// weight to pick lights by.  [W/(m² sr)]
  template <int channels, Real F, class Space, ParallelLight L, DrawsPoints<F> Points>
  static F unoccluded(const Medium& medium, const Space& space, const L& light, int light_index,
                      const MediumRay<F>& whole_ray, const Points& sampler) noexcept {
    const auto lit = lit_part(light, medium, space, whole_ray);
    const MediumRay<F>& ray = lit.ray;
    if (!any(ray.active)) return F(0);
    const Vec3<F> w = toward<F>(light, light_index, ray.index, sampler);
    auto section = section_along<F, channels>(medium, lit.space, ray, space.vector(w));
    section.trace_way_out();
    const Rgb<F> radiance = Rgb<F>(strength_along<Space>(medium, light.irradiance)) * ray.dimmed *
                            to_rgb<F>(section.integral) *
                            phase_along<Space>(medium, dot(w, ray.direction));
    return (radiance.r + radiance.g + radiance.b) * F(1. / 3);
  }

  /// Adds the samples of one camera ray for one light: all of them or, with a share, those that the
  /// light gets. `channels` is 1 for a grey medium and 3 otherwise; `watch` is told of every
  /// sample.
  template <int channels, Real F, class Space, ParallelLight L, DrawsPoints<F> Points,
            AnswersVisibility<F> W, class Watch>
  void add(const Medium& medium, const Space& space, const L& light, int light_index,
           const MediumRay<F>& whole_ray, SampleRange samples, bool halve_by_ray,
           const Points& sampler, const W& world, Halves<F>& sums, Watch&& watch,
           const LightShare<F>* share = nullptr) const noexcept {
    const auto lit = lit_part(light, medium, space, whole_ray);
    const MediumRay<F>& ray = lit.ray;
    if (!any(ray.active)) return;
    const Vec3<F> w = toward<F>(light, light_index, ray.index, sampler);

    auto section = section_along<F, channels>(medium, lit.space, ray, space.vector(w));
    if (!intersect_every_step) section.trace_way_out();

    const Rgb<F> strength = Rgb<F>(strength_along<Space>(medium, light.irradiance)) * ray.dimmed *
                            phase_along<Space>(medium, dot(w, ray.direction));

    HalvedWeights<F> weights{halve_by_ray ? half_of(ray.index) : -1};
    std::visit(
        [&](const Placement auto& place) {
          const auto placed =
              place.on(section, carried<channels, Space>(medium, light, ray.dimmed));
          const OnRay<F, L, decltype(section), std::remove_const_t<decltype(placed)>> on_ray{
              ray, light, light_index, w, section, placed, share, intersect_every_step};
          for_each_drawn<F>(
              on_ray, samples, weights.half,
              sampler.stream(share ? stream::light_choice : stream::distance(light_index)),
              [&](std::uint32_t i, const auto& d) {
                if (share && !any(d.asked)) return;
                const Rgb<F> visible = on_ray.visibility(d, world);
                watch(on_ray.watched(i, d, visible));
                weights.add(d, visible);
              });
        },
        placement);

    const auto count = weights.counts(samples);
    const Rgb<F> analytic =
        intersect_every_step ? Rgb<F>() : strength * to_rgb<F>(section.integral);
    std::visit(
        [&](const Form auto& make) {
          for (int half = 0; half < 2; ++half)
            sums[half] +=
                make(analytic * F(Scalar<F>(count[half])), strength * weights.occluded[half],
                     strength * weights.unoccluded[half]);
        },
        form);
  }

  template <int channels, Real F, class Space, ParallelLight L, DrawsPoints<F> Points,
            AnswersVisibility<F> W>
  void add(const Medium& medium, const Space& space, const L& light, int light_index,
           const MediumRay<F>& ray, SampleRange samples, bool halve_by_ray, const Points& sampler,
           const W& world, Halves<F>& sums) const noexcept {
    add<channels>(medium, space, light, light_index, ray, samples, halve_by_ray, sampler, world,
                  sums, [](const WatchedSample<F>&) {});
  }
};

}  // namespace airlight::inline AIRLIGHT_ISA
