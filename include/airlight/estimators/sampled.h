#pragma once
#include <algorithm>

#include "../estimator.h"
#include "../forms.h"
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

/// The samples that a light gets of a ray where each sample asks one light only: those whose
/// number, times the sum of all lights' weights, falls on this light's. Picked with probability
/// weight / total, the light counts for total / weight as much (Velinov 2021 section 1.1).
template <Real F>
struct LightShare {
  F below;   ///< the sum of the weights of the lights before this one
  F weight;  ///< >= 0
  F total;   ///< of all lights' weights

  /// Whether the light is the one for u in [0, 1), and u made uniform in [0, 1] again if so: one
  /// number serves both, and strata stay strata.
  Mask<F> takes(F& u) const noexcept {
    const F x = u * total;
    u = clamp((x - below) / select(weight > F(0), weight, F(1)), F(0), F(1));
    return (x >= below) & (x < below + weight);
  }

  /// What a sample of the light counts for; of a light that is all but never picked, finite.
  F boost() const noexcept { return min(total / select(weight > F(0), weight, F(1)), F(1e30f)); }
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
    Rgb<F> weight;
    Vec3<F> from;
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

    const int one_half = halve_by_ray ? half_of(ray.index) : -1;
    std::array<Rgb<F>, 2> occluded, unoccluded;
    std::visit(
        [&](const Placement auto& place) {
          const auto placed =
              place.on(section, carried<channels, Space>(medium, light, ray.dimmed));
          static_assert(PlacedOn<decltype(placed), decltype(section)>);
          const auto distances =
              sampler.stream(share ? stream::light_choice : stream::distance(light_index));
          using Sample = Drawn<F, typename decltype(section)::Point>;
          const auto draw = [&](UInt<F> bits) {
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
            return d;
          };
          const auto trace = [&](std::uint32_t i, Sample& d) {
            if (share) {
              if (!any(d.asked)) return;
              d.weight = d.weight * select(d.asked, share->boost(), F(0));
            }
            Rgb<F> visible = world.transmit(d.from, w, d.reach, light_index, d.asked);
            if (ray.filtered)
              visible *= world.transmit(ray.origin, ray.direction, d.along, no_light, d.asked);
            const F pdf = placed.pdf(d.t, d.at);
            watch(WatchedSample<F>{i, d.along, share ? pdf / share->boost() : pdf,
                                   d.weight * ray.dimmed, visible, d.asked});
            const Rgb<F> none, sent = select(d.asked, d.weight, none), arrived = d.weight * visible;
            if (one_half >= 0) {
              occluded[one_half] += arrived, unoccluded[one_half] += sent;
            } else {
              occluded[0] += select(d.second, none, arrived);
              occluded[1] += select(d.second, arrived, none);
              unoccluded[0] += select(d.second, none, sent);
              unoccluded[1] += select(d.second, sent, none);
            }
          };
          const std::uint32_t end = samples.first + samples.count;
          for (std::uint32_t i = samples.first; i < end; i += drawn_ahead) {
            const int n = int(std::min(std::uint32_t(drawn_ahead), end - i));
            UInt<F> bits[drawn_ahead];
            random_bits<F>(distances, i, n, one_half, bits);
            Later<Sample> drawn[drawn_ahead];
            for (int k = 0; k < n; ++k) drawn[k].sample = draw(bits[k]);
            for (int k = 0; k < n; ++k) trace(i + std::uint32_t(k), drawn[k].sample);
          }
        },
        placement);

    std::array<std::uint32_t, 2> count{};
    for (std::uint32_t i = 0; i < samples.count; ++i)
      ++count[std::size_t(one_half < 0 ? half_of(samples.first + i) : one_half)];
    const Rgb<F> analytic =
        intersect_every_step ? Rgb<F>() : strength * to_rgb<F>(section.integral);
    std::visit(
        [&](const Form auto& make) {
          for (int half = 0; half < 2; ++half)
            sums[half] += make(analytic * F(Scalar<F>(count[half])), strength * occluded[half],
                               strength * unoccluded[half]);
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
