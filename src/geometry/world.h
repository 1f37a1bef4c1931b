#pragma once
#include <optional>
#include <vector>

#include "geometry/among.h"
#include "geometry/beam_image.h"
#include "geometry/embree_surfaces.h"
#include "geometry/exact_surfaces.h"
#include "geometry/hit.h"
#include "geometry/surface_filter.h"
#include "scene/scene.h"

namespace airlight {

/// What a surface is like at a point.
struct SurfacePoint {
  // On an arbitrary side, and of any length: kernels bring whole packets of them to unit length.
  Vec3<float> normal;            ///< interpolated as the mesh says
  Vec3<float> geometric_normal;  ///< of the triangle itself
  Rgb<float> albedo;             ///< diffuse
  float opacity;                 ///< in [0, 1]
  Rgb<float> transmittance;      ///< (1 − opacity) · tint
  std::uint32_t object;          ///< index into Scene::objects
  bool holdout;                  ///< as the object's
};

/// What a kernel may ask of the scene's surfaces. Any thread may ask at any time. Rays do not know
/// the surface they start on: one that leaves a surface starts a little above it.
class World {
 public:
  /// How far above a surface such a ray starts, over |x| + |y| + |z| of the point and the distance
  /// from which it was found: single precision knows points no better far from the origin.
  static constexpr double lift = 2e-5;

  /// Builds what answers the rays. The scene must outlive the World and must not change: meshes are
  /// shared with it. Throws Error if memory does not suffice.
  World(const Scene& scene, Visibility visibility);
  World(const Scene&& scene, Visibility visibility) = delete;

  /// What light is multiplied by on the way from `from` to `from + t_max dir`: the product of (1 −
  /// opacity) · tint over the surfaces it crosses; 1 is free, 0 blocked. 0 in lanes that are not
  /// active. `light` is an index into Scene::lights, whose image, if it has one, counts too, or
  /// `no_light`. How the rays lie is a matter of speed alone, here and below.
  template <Real F>
  Rgb<F> transmit(Vec3<F> from, Vec3<F> dir, F t_max, int light, Mask<F> active,
                  Bundle bundle = Bundle::loose) const noexcept;

  /// The same if there were no objects but holdouts; `passed` is what `transmit` says of these
  /// segments.
  template <Real F>
  Rgb<F> transmit_by_holdouts(Vec3<F> from, Vec3<F> dir, F t_max, int light, Mask<F> active,
                              const Rgb<F>& passed, Bundle bundle = Bundle::loose) const noexcept;

  /// The nearest surface beyond t_min that does something to light. Not found in lanes that are not
  /// active.
  template <Real F>
  Hit<F> closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                 Bundle bundle = Bundle::loose) const noexcept;

  /// The surface at a hit's point.
  SurfacePoint surface(std::uint32_t object, std::uint32_t primitive, float u,
                       float v) const noexcept;

  /// The Embree scene itself, for measuring against it; null for analytic visibility.
  RTCScene embree() const noexcept { return all_.embree ? all_.embree->handle() : nullptr; }

 private:
  /// Some of the objects.
  struct Surfaces {
    std::optional<EmbreeSurfaces> embree;  ///< either this
    std::optional<ExactSurfaces> exact;    ///< or this

    Surfaces(const Scene& scene, Visibility visibility, std::span<const SurfaceFilter> filters,
             Among among);
  };

  template <Real F>
  Rgb<F> transmit(const Surfaces& some, Vec3<F> from, Vec3<F> dir, F t_max, int light,
                  Mask<F> active, Bundle bundle) const noexcept;

  const Scene* scene_;
  std::vector<SurfaceFilter> surfaces_;  ///< one an object; a move leaves them where they are
  Surfaces all_;
  std::optional<Surfaces> holdouts_;  ///< where there are others besides
};

template <Real F>
Rgb<F> World::transmit(Vec3<F> from, Vec3<F> dir, F t_max, int light, Mask<F> active,
                       Bundle bundle) const noexcept {
  return transmit(all_, from, dir, t_max, light, active, bundle);
}

template <Real F>
Rgb<F> World::transmit_by_holdouts(Vec3<F> from, Vec3<F> dir, F t_max, int light, Mask<F> active,
                                   const Rgb<F>& passed, Bundle bundle) const noexcept {
  if (!holdouts_) return passed;
  const Mask<F> held_back = active & (passed.r + passed.g + passed.b < F(3));
  return select(held_back, transmit(*holdouts_, from, dir, t_max, light, held_back, bundle),
                passed);
}

template <Real F>
Rgb<F> World::transmit(const Surfaces& some, Vec3<F> from, Vec3<F> dir, F t_max, int light,
                       Mask<F> active, Bundle bundle) const noexcept {
  if (!any(active)) return {};
  Rgb<F> passed = some.embree ? some.embree->transmit(from, dir, t_max, active, bundle)
                              : some.exact->transmit(from, dir, t_max, active, surfaces_);
  if (std::size_t(light) >= scene_->lights.size()) return passed;
  if (const auto* beam = std::get_if<Collimated>(&scene_->lights[std::size_t(light)]))
    if (beam->image >= 0)
      passed *= through_image(*beam, scene_->textures[std::size_t(beam->image)], from, active);
  return passed;
}

template <Real F>
Hit<F> World::closest(Vec3<F> origin, Vec3<F> dir, F t_min, Mask<F> active,
                      Bundle bundle) const noexcept {
  const auto& [embree, exact] = all_;
  if (embree && any(active)) return embree->closest(origin, dir, t_min, active, bundle);
  if (exact && any(active)) return exact->closest(origin, dir, t_min, active, surfaces_);
  return Hit<F>::none();
}

}  // namespace airlight
