#pragma once
/// What a packet of camera rays meets: surfaces one behind the other, glass and cut-outs between,
/// the background.
#include <span>

#include "render/frame.h"

namespace airlight {

template <Real F, class Space>
class SurfaceWalk {
 public:
  /// `radiance`: room for one colour a light group.
  SurfaceWalk(const Frame& frame, const Medium* medium, const Space& space,
              const Sampler<F>& sampler, std::span<Rgb<F>> radiance) noexcept
      : radiance(radiance), frame_(frame), medium_(medium), space_(space), sampler_(sampler) {
    for (Rgb<F>& group : radiance) group = {};
  }

  Rgb<F> background;  ///< what is behind everything, to be set before the walk  [W/(m² sr)]

  std::span<Rgb<F>>
      radiance;          ///< of surfaces and background, as it reaches the camera, by light group
  F t_end{F(far_away)};  ///< where nothing passes any more  [m]
  Rgb<F> emission;       ///< of the medium, as it reaches the camera
  Rgb<F> through{F(1)};  ///< what passes from the end of the ray to the camera
  Rgb<F> uncovered;      ///< what passes from the background, also where holdouts show it
  Rgb<F> albedo;         ///< of the first surface; 0 without one
  Vec3<F> normal;        ///< of the first surface, towards the camera; 0 without one
  F depth{F(0)}, object{F(0)};
  bool filtered = false;  ///< whether any lane crosses something that lets light through

  void along(Vec3<F> origin, Vec3<F> direction, Interval<F> inside, SampleRange samples,
             Mask<F> active) noexcept {
    F t(0);
    bool first = true;
    Rgb<F> filter(F(1));  // of all crossed so far
    for (int crossed = 0; crossed < most_crossings && any(active); ++crossed) {
      const Hit<F> hit = frame_.world.template closest<F>(origin, direction, t, active);
      const Mask<F> found = hit.found & active;
      const F t_next = select(found, hit.t, F(far_away));
      const Rgb<F> glow = filter * emitted(inside, t, t_next);
      emission = select(active, emission + glow, emission);
      const Rgb<F> dim = filter * attenuation(inside, t_next);
      uncovered = select(active & !found, uncovered + dim, uncovered);
      through = select(active, dim, through);
      if (!any(found)) break;

      const Crossing at = crossing(hit, bits<F>(found), direction);
      uncovered = select(found, uncovered + dim * at.uncovered, uncovered);
      shade(at, dim, origin, direction, hit.t, samples, found);
      if (first) {
        albedo = select(found, at.albedo, albedo);
        normal = select(found, at.normal, normal);
        depth = select(found, hit.t, depth);
        object = select(found, at.object, object);
        first = false;
      }
      const Mask<F> passes = found & ((at.filter.r + at.filter.g + at.filter.b) > F(0));
      t_end = select(found & !passes, hit.t, t_end);
      filter = select(passes, filter * at.filter, filter);
      through = select(passes, dim * at.filter, through);
      filtered = filtered || any(passes);
      t = hit.t;
      active = passes;
    }
    radiance[Frame::ungrouped] += uncovered * background;
  }

 private:
  /// Behind so many sheets of glass or leaves nothing is looked for any more.
  static constexpr int most_crossings = 128;

  /// A packet's surfaces.
  struct Crossing {
    Vec3<F> normal, geometric;  ///< towards the viewer
    Rgb<F> albedo;              ///< times opacity; black in holdouts, which the camera does not see
    Rgb<F> filter;              ///< what the surface lets through
    F object;                   ///< 1 + index
    F uncovered;                ///< the opacity of a holdout; 0 of other surfaces
  };

  Crossing crossing(const Hit<F>& hit, std::uint32_t found, Vec3<F> direction) const noexcept {
    alignas(64) Scalar<F> values[14][lanes<F>] = {};
    for (int i = 0; i < lanes<F>; ++i) {
      if (!((found >> i) & 1u)) continue;
      const auto k = std::size_t(i);
      const SurfacePoint s =
          frame_.world.surface(hit.object[k], hit.primitive[k], hit.u[k], hit.v[k]);
      const float holdout = s.holdout ? s.opacity : 0;
      const float own = s.opacity - holdout;
      const float numbers[14] = {s.normal.x,           s.normal.y,
                                 s.normal.z,           s.geometric_normal.x,
                                 s.geometric_normal.y, s.geometric_normal.z,
                                 s.albedo.r * own,     s.albedo.g * own,
                                 s.albedo.b * own,     s.transmittance.r,
                                 s.transmittance.g,    s.transmittance.b,
                                 float(s.object + 1),  holdout};
      for (int j = 0; j < 14; ++j) values[j][i] = numbers[j];
    }
    const auto at = [&](int j) { return load<F>(values[j]); };
    Crossing c;
    c.geometric = Vec3<F>(at(3), at(4), at(5));
    c.geometric = select(dot(c.geometric, direction) > F(0), -c.geometric, c.geometric);
    c.normal = Vec3<F>(at(0), at(1), at(2));
    c.normal = select(dot(c.normal, c.geometric) < F(0), -c.normal, c.normal);
    c.albedo = Rgb<F>(at(6), at(7), at(8));
    c.filter = Rgb<F>(at(9), at(10), at(11));
    c.object = at(12);
    c.uncovered = at(13);
    return c;
  }

  void add(int group, const Rgb<F>& light, Mask<F> where) noexcept {
    Rgb<F>& sum = radiance[std::size_t(group)];
    sum = select(where, sum + light, sum);
  }

  /// Adds the diffuse reflection of every light and of the ambient radiance, towards the camera, of
  /// which `dim` arrives there; the medium dims light on its way in (Velinov 2021 Eq. 1 with a
  /// Lambertian surface).  [W/(m² sr)]
  void shade(const Crossing& at, const Rgb<F>& dim, Vec3<F> origin, Vec3<F> direction, F t,
             SampleRange samples, Mask<F> found) noexcept {
    found = found & ((at.albedo.r + at.albedo.g + at.albedo.b) > F(0));
    if (!any(found)) return;  // black
    const Rgb<F> reflected = dim * at.albedo;
    if (frame_.scene.ambient != Rgb<double>())
      add(Frame::ungrouped, reflected * Rgb<F>(frame_.scene.ambient), found);
    const Vec3<F> p = origin + direction * t;
    // Shadow rays start a little off the surface: the hit is known to a few roundings of its
    // coordinates.
    const F lift = F(2e-5) * (abs(p.x) + abs(p.y) + abs(p.z) + t);
    const Vec3<F> from = p + at.geometric * lift;
    const Rgb<F> lambert = reflected * F(1 / pi);
    for (int i = 0; i < int(frame_.scene.lights.size()); ++i)
      std::visit(
          [&](const auto& light) {
            add(frame_.light_group[std::size_t(i)],
                lambert * irradiance(light, i, at, p, from, samples, found), found);
          },
          frame_.scene.lights[std::size_t(i)]);
  }

  /// Of a beam at the point p.  [W/m²]
  Rgb<F> irradiance(const Collimated& beam, int light_index, const Crossing& at, Vec3<F> p,
                    Vec3<F> from, SampleRange, Mask<F> found) const noexcept {
    const Vec3<F> toward(beam.toward());
    const Mask<F> struck = found & beam.contains(p);
    if (!any(struck)) return {};
    return arriving(toward, beam.reach(from), light_index, at, p, from, struck) *
           Rgb<F>(beam.irradiance);
  }

  /// Of light at the point p, whose shadow rays start at `from`: the mean over the samples of the
  /// camera ray. Directions to a disc belong to samples by their numbers, so that ranges of samples
  /// add up to the whole.  [W/m²]
  Rgb<F> irradiance(const Directional& light, int light_index, const Crossing& at, Vec3<F> p,
                    Vec3<F> from, SampleRange samples, Mask<F> found) const noexcept {
    if (!(light.angular_diameter > 0))
      return arriving(Vec3<F>(light.toward()), F(far_away), light_index, at, p, from, found) *
             Rgb<F>(light.irradiance);
    Rgb<F> sum;
    const std::uint32_t end = samples.first + samples.count;
    for (std::uint32_t i = samples.first; i < end;) {
      const std::uint32_t index = i / frame_.samples_per_surface_ray;
      const std::uint32_t stop = std::min(end, (index + 1) * frame_.samples_per_surface_ray);
      const Vec3<F> w = uniform_cap(Vec3<F>(light.toward()), F(Scalar<F>(light.cap_height())),
                                    sampler_.two(index, stream::surface(light_index)));
      sum += arriving(w, F(far_away), light_index, at, p, from, found) * F(Scalar<F>(stop - i));
      i = stop;
    }
    return sum * Rgb<F>(light.irradiance) * F(Scalar<F>(1. / samples.count));
  }

  /// The part of the light from w, where it starts `reach` away, that the surface receives: cosine,
  /// shadows, fog.
  Rgb<F> arriving(Vec3<F> w, F reach, int light_index, const Crossing& at, Vec3<F> p, Vec3<F> from,
                  Mask<F> found) const noexcept {
    const F cosine = max(dot(at.normal, w), F(0));
    const Mask<F> faces = found & (cosine > F(0)) & (dot(at.geometric, w) > F(0));
    if (!any(faces)) return {};
    Rgb<F> part = frame_.world.transmit(from, w, reach, light_index, faces) * cosine;
    if (medium_) {
      const Interval<F> chord = space_.clip(LocalRay<F>{space_.point(p), space_.vector(w)});
      part *= extinguished(max(min(chord.t_exit, reach) - chord.t_enter, F(0)));
    }
    return select(faces, part, Rgb<F>());
  }

  /// e^{−σ length}.
  Rgb<F> extinguished(F length) const noexcept {
    if (!medium_) return Rgb<F>(F(1));
    return exp_minus(Rgb<F>(medium_->sigma_t) * length);
  }

  /// Of the medium between the camera and t.
  Rgb<F> attenuation(Interval<F> inside, F t) const noexcept {
    return extinguished(max(min(t, inside.t_exit) - inside.t_enter, F(0)));
  }

  /// ∫ j e^{−σ s} ds over the part of the medium between two distances, in closed form.
  Rgb<F> emitted(Interval<F> inside, F from, F to) const noexcept {
    if (!medium_ || medium_->emission == Rgb<double>()) return {};
    const F begin = clamp(from, inside.t_enter, inside.t_exit);
    const F length = clamp(to, inside.t_enter, inside.t_exit) - begin;
    const Rgb<F> sigma(medium_->sigma_t);
    const Rgb<F> mean(phi(sigma.r * length), phi(sigma.g * length), phi(sigma.b * length));
    return Rgb<F>(medium_->emission) * extinguished(begin - inside.t_enter) * mean * length;
  }

  const Frame& frame_;
  const Medium* medium_;
  const Space& space_;
  const Sampler<F>& sampler_;
};

}  // namespace airlight
