#pragma once
/// Where a packet of rays meets surfaces, and the light that these receive and send back.
#include <airlight/media.h>

#include <span>

#include "render/frame.h"
#include "render/holdout_sums.h"

namespace airlight {

/// What a packet of rays meets.
template <Real F>
struct Crossing {
  Vec3<F> point;              ///< [m]
  Vec3<F> above;              ///< a little off the surface, where rays that leave it start  [m]
  Vec3<F> normal, geometric;  ///< towards the viewer
  Rgb<F> albedo;              ///< times opacity; black in holdouts, which the camera does not see
  Rgb<F> filter;              ///< what the surface lets through
  F object;                   ///< 1 + index
  F uncovered;                ///< the opacity of a holdout; 0 of other surfaces
};

/// An amount of light with shadows and without.
template <Real F>
struct Shadowed {
  Rgb<F> occluded, unoccluded;

  Shadowed& operator+=(const Shadowed& other) noexcept {
    occluded += other.occluded, unoccluded += other.unoccluded;
    return *this;
  }
  friend Shadowed operator*(const Shadowed& s, const Rgb<F>& part) noexcept {
    return {s.occluded * part, s.unoccluded * part};
  }
};

template <Real F, class Space, DrawsPoints<F> Points>
class SurfaceLight {
 public:
  /// `bundle`: how the points that a packet asks about lie.
  SurfaceLight(const Frame& frame, const Medium* medium, const Space& space, const Points& sampler,
               Bundle bundle) noexcept
      : frame_(frame), medium_(medium), space_(space), sampler_(sampler), bundle_(bundle) {}

  Crossing<F> crossing(const Hit<F>& hit, Mask<F> where, Vec3<F> origin,
                       Vec3<F> direction) const noexcept {
    const std::uint32_t found = bits<F>(where);
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
    Crossing<F> c;
    c.point = origin + direction * hit.t;
    const Vec3<F> none(F(0), F(0), F(1));
    c.geometric = normalize(select(where, Vec3<F>(at(3), at(4), at(5)), none));
    c.geometric = select(dot(c.geometric, direction) > F(0), -c.geometric, c.geometric);
    c.normal = normalize(select(where, Vec3<F>(at(0), at(1), at(2)), none));
    c.normal = select(dot(c.normal, c.geometric) < F(0), -c.normal, c.normal);
    c.albedo = Rgb<F>(at(6), at(7), at(8));
    c.filter = Rgb<F>(at(9), at(10), at(11));
    c.object = at(12);
    c.uncovered = at(13);
    const F lift = F(World::lift) * (abs(c.point.x) + abs(c.point.y) + abs(c.point.z) + hit.t);
    c.above = c.point + c.geometric * lift;
    return c;
  }

  /// What a diffuse surface sends back of every light, times `dim`: the medium dims light on its
  /// way in (Velinov 2021 Eq. 1 with a Lambertian surface). sink(light, radiance) is told where
  /// `where` holds.  [W/(m² sr)]
  template <class Sink>
  void reflect(const Crossing<F>& at, const Rgb<F>& dim, SampleRange samples, Mask<F> where,
               Sink&& sink) const noexcept {
    const Rgb<F> lambert = dim * at.albedo * F(1 / pi);
    for (int i = 0; i < int(frame_.scene.lights.size()); ++i)
      std::visit(
          [&](const auto& light) {
            const auto arrives = [&](Vec3<F> w, F reach, Mask<F> struck) {
              return arriving(w, reach, i, at, struck);
            };
            sink(i, irradiance(light, i, at, samples, where, arrives) * lambert);
          },
          frame_.scene.lights[std::size_t(i)]);
  }

  /// What is seen of holdouts: `seen` is what passes from them to the camera, `background` stands
  /// in their place. Adds the light that arrives there by its group; every sample counts with all
  /// shadows and with those of holdouts alone.
  HoldoutSums<F> holdouts(const Crossing<F>& at, const Rgb<F>& seen, const Rgb<F>& background,
                          SampleRange samples, Mask<F> where,
                          std::span<HoldoutLight<F>> groups) const noexcept {
    const Rgb<F> passes = select(where, seen, Rgb<F>());
    const auto add = [&](int group, const Shadowed<F>& light) {
      groups[std::size_t(group)] +=
          HoldoutLight<F>{passes * light.occluded, passes * light.unoccluded};
    };
    const Rgb<F> ambient(frame_.scene.ambient * pi);
    add(Frame::ungrouped, {ambient, ambient});
    for (int i = 0; i < int(frame_.scene.lights.size()); ++i)
      std::visit(
          [&](const auto& light) {
            add(frame_.light_group[std::size_t(i)],
                irradiance(light, i, at, samples, where, [&](Vec3<F> w, F reach, Mask<F> struck) {
                  return arriving_at_holdout(w, reach, i, at, struck);
                }));
          },
          frame_.scene.lights[std::size_t(i)]);
    return {passes, passes * background};
  }

 private:
  /// Of a beam at a point of a surface; arrives(w, reach, where) says which part of it.  [W/m²]
  template <class Arrives>
  Shadowed<F> irradiance(const Collimated& beam, int, const Crossing<F>& at, SampleRange,
                         Mask<F> found, const Arrives& arrives) const noexcept {
    const Mask<F> struck = found & beam.contains(at.point);
    if (!any(struck)) return {};
    return arrives(Vec3<F>(beam.toward()), beam.reach(at.above), struck) * Rgb<F>(beam.irradiance);
  }

  /// Of a light at a point of a surface: the mean over the samples of the ray that came there.
  /// Directions to a disc belong to samples by their numbers, so that ranges of samples add up to
  /// the whole.  [W/m²]
  template <class Arrives>
  Shadowed<F> irradiance(const Directional& light, int light_index, const Crossing<F>&,
                         SampleRange samples, Mask<F> found,
                         const Arrives& arrives) const noexcept {
    if (!(light.angular_diameter > 0))
      return arrives(Vec3<F>(light.toward()), F(far_away), found) * Rgb<F>(light.irradiance);
    Shadowed<F> sum;
    const std::uint32_t end = samples.first + samples.count;
    for (std::uint32_t i = samples.first; i < end;) {
      const std::uint32_t index = i / frame_.samples_per_surface_ray;
      const std::uint32_t stop = std::min(end, (index + 1) * frame_.samples_per_surface_ray);
      const Vec3<F> w = uniform_cap(Vec3<F>(light.toward()), F(Scalar<F>(light.cap_height())),
                                    sampler_.two(index, stream::surface(light_index)));
      sum += arrives(w, F(far_away), found) * Rgb<F>(F(Scalar<F>(stop - i)));
      i = stop;
    }
    return sum * (Rgb<F>(light.irradiance) * F(Scalar<F>(1. / samples.count)));
  }

  /// The part of the light from w, where it starts `reach` away, that the surface receives: cosine,
  /// fog, shadows.
  Shadowed<F> arriving(Vec3<F> w, F reach, int light_index, const Crossing<F>& at,
                       Mask<F> found) const noexcept {
    const F cosine = cosine_of(w, at);
    const Mask<F> faces = found & (cosine > F(0));
    if (!any(faces)) return {};
    const Rgb<F> visible = frame_.world.transmit(at.above, w, reach, light_index, faces, bundle_);
    const Rgb<F> part = through_medium(w, reach, at) * cosine;
    return {select(faces, part * visible, Rgb<F>()), select(faces, part, Rgb<F>())};
  }

  /// The same at a holdout, where what counts as shadow is the medium and what is no holdout.
  Shadowed<F> arriving_at_holdout(Vec3<F> w, F reach, int light_index, const Crossing<F>& at,
                                  Mask<F> found) const noexcept {
    const F cosine = cosine_of(w, at);
    const Mask<F> faces = found & (cosine > F(0));
    if (!any(faces)) return {};
    const World& world = frame_.world;
    const Rgb<F> visible = world.transmit(at.above, w, reach, light_index, faces, bundle_);
    const Rgb<F> was =
        world.transmit_by_holdouts(at.above, w, reach, light_index, faces, visible, bundle_) *
        cosine;
    const Rgb<F> is = visible * cosine * through_medium(w, reach, at);
    return {select(faces, is, Rgb<F>()), select(faces, was, Rgb<F>())};
  }

  /// Between the normal and w; 0 on the side that light from w does not reach.
  static F cosine_of(Vec3<F> w, const Crossing<F>& at) noexcept {
    return select(dot(at.geometric, w) > F(0), max(dot(at.normal, w), F(0)), F(0));
  }

  /// What the medium leaves of light from w, where it starts `reach` away.
  Rgb<F> through_medium(Vec3<F> w, F reach, const Crossing<F>& at) const noexcept {
    if (!medium_) return Rgb<F>(F(1));
    const LocalRay<F> to_light{space_.point(at.point), space_.vector(w)};
    return stretches_of(medium_, space_, to_light).transmittance(reach);
  }

  const Frame& frame_;
  const Medium* medium_;
  const Space& space_;
  const Points& sampler_;
  Bundle bundle_;
};

}  // namespace airlight
