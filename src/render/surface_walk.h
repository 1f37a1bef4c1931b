#pragma once
/// What a packet of camera rays meets: surfaces one behind the other, glass and cut-outs between,
/// the background.
#include <algorithm>
#include <span>
#include <vector>

#include "render/surface_light.h"

namespace airlight {

/// Room for what a walk finds, by light group.
template <Real F>
struct WalkRoom {
  std::vector<Rgb<F>> radiance;
  std::vector<HoldoutLight<F>> holdout_light;

  explicit WalkRoom(const FilmLayout& layout)
      : radiance(std::size_t(layout.groups)),
        holdout_light(layout.shadow ? std::size_t(layout.groups) : 0) {}
};

template <Real F, class Space>
class SurfaceWalk {
 public:
  /// `groups`: room for what each light group sends.
  SurfaceWalk(const Frame& frame, const Medium* medium, const Space& space,
              const Sampler<F>& sampler, WalkRoom<F>& groups) noexcept
      : radiance(groups.radiance),
        holdout_light(groups.holdout_light),
        frame_(frame),
        surfaces_(frame, medium, space, sampler, Bundle::tight) {
    std::ranges::fill(radiance, Rgb<F>());
    std::ranges::fill(holdout_light, HoldoutLight<F>());
  }

  Rgb<F> background;  ///< what is behind everything, to be set before the walk  [W/(m² sr)]

  std::span<Rgb<F>> radiance;  ///< of surfaces and background, as it reaches the camera, by light
                               ///< group, without what is in `holdouts`
  F t_end{F(far_away)};        ///< where nothing passes any more  [m]
  Rgb<F> emission;             ///< of the medium, as it reaches the camera
  Rgb<F> through{F(1)};        ///< what passes from the end of the ray to the camera
  Rgb<F> uncovered;            ///< what passes from the background, also where holdouts show it
  HoldoutSums<F> holdouts;     ///< if they may be shadowed
  std::span<HoldoutLight<F>> holdout_light;  ///< by light group
  Rgb<F> albedo;                             ///< of the first surface; 0 without one
  Vec3<F> normal;  ///< of the first surface, towards the camera; 0 without one
  F depth{F(0)}, object{F(0)};
  bool filtered = false;  ///< whether any lane crosses something that lets light through

  template <class Inside>
  void along(Vec3<F> origin, Vec3<F> direction, const Inside& inside, SampleRange samples,
             Mask<F> active) noexcept {
    F t(0);
    bool first = true;
    Rgb<F> filter(F(1));  // of all crossed so far
    // Every step lies beyond the one before and a surface is met once: there are no more of them
    // than surfaces.
    while (any(active)) {
      const Hit<F> hit =
          frame_.world.template closest<F>(origin, direction, t, active, Bundle::tight);
      const Mask<F> found = hit.found & active;
      const F t_next = select(found, hit.t, F(far_away));
      const Rgb<F> glow = filter * inside.emitted(t, t_next);
      emission = select(active, emission + glow, emission);
      const Rgb<F> dim = filter * inside.transmittance(t_next);
      uncovered = select(active & !found, uncovered + dim, uncovered);
      through = select(active, dim, through);
      if (!any(found)) break;

      const Crossing<F> at = surfaces_.crossing(hit, found, origin, direction);
      const Rgb<F> shown = dim * at.uncovered;
      uncovered = select(found, uncovered + shown, uncovered);
      if (const Mask<F> held = found & (at.uncovered > F(0)); frame_.layout.shadow && any(held))
        holdouts += surfaces_.holdouts(at, shown, background, samples, held, holdout_light);
      shade(at, dim, samples, found);
      if (first) {
        albedo = select(found, at.albedo, albedo);
        normal = select(found, at.normal, normal);
        depth = select(found, hit.t, depth);
        object = select(found, at.object, object);
        first = false;
      }
      const Rgb<F> left = filter * at.filter;  // zero, too, where it is too little for a number
      const Mask<F> passes = found & (left.r + left.g + left.b > F(0));
      t_end = select(found & !passes, hit.t, t_end);
      filter = select(passes, left, filter);
      through = select(passes, dim * at.filter, through);
      filtered = filtered || any(passes);
      t = hit.t;
      active = passes;
    }
    radiance[Frame::ungrouped] += (uncovered - holdouts.seen) * background;
  }

  /// What the camera sees of the background in the place of holdouts.  [W/(m² sr)]
  Rgb<F> plate() const noexcept {
    HoldoutLight<F> all;
    for (const HoldoutLight<F>& group : holdout_light) all += group;
    return holdouts.plate * all.shadow();
  }

 private:
  void add(int group, const Rgb<F>& light, Mask<F> where) noexcept {
    Rgb<F>& sum = radiance[std::size_t(group)];
    sum = select(where, sum + light, sum);
  }

  /// Adds the diffuse reflection of every light and of the ambient radiance, towards the camera, of
  /// which `dim` arrives there.  [W/(m² sr)]
  void shade(const Crossing<F>& at, const Rgb<F>& dim, SampleRange samples,
             Mask<F> found) noexcept {
    found = found & ((at.albedo.r + at.albedo.g + at.albedo.b) > F(0));
    if (!any(found)) return;  // black
    if (frame_.scene.ambient != Rgb<double>())
      add(Frame::ungrouped, dim * at.albedo * Rgb<F>(frame_.scene.ambient), found);
    surfaces_.reflect(at, dim, samples, found, [&](int light, const Shadowed<F>& reflected) {
      add(frame_.light_group[std::size_t(light)], reflected.occluded, found);
    });
  }

  const Frame& frame_;
  SurfaceLight<F, Space, Sampler<F>> surfaces_;
};

}  // namespace airlight
