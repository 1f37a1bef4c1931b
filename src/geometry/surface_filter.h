#pragma once
#include <airlight/math/vec.h>

#include <array>
#include <cstdint>

namespace airlight {

struct Object;
struct Scene;
struct Texture;

/// What an object lets through, point by point. A point is named as Embree names it: a primitive
/// and two coordinates, on a triangle the barycentric weights of its second and third corner, on a
/// sphere those of `sphere_coordinates`. Keeps pointers to the scene's object and texture.
class SurfaceFilter {
 public:
  SurfaceFilter(const Scene& scene, const Object& object);

  /// Whether no light passes anywhere.
  bool is_opaque() const noexcept { return texture_ == nullptr && opacity_ >= 1; }
  /// Whether all light passes everywhere, unchanged.
  bool is_clear() const noexcept { return texture_ == nullptr && opacity_ <= 0 && tint_is_white_; }

  /// The part of the light that is held back, before the tint, in [0, 1].
  float opacity(std::uint32_t primitive, float u, float v) const noexcept;
  /// What light is multiplied by that crosses the surface: (1 − opacity) · tint.
  Rgb<float> transmittance(std::uint32_t primitive, float u, float v) const noexcept {
    return transmittance(opacity(primitive, u, v));
  }
  Rgb<float> transmittance(float opacity) const noexcept { return tint_ * (1 - opacity); }
  /// Whether the surface does nothing to light there, so that one cannot see it either.
  bool is_clear(std::uint32_t primitive, float u, float v) const noexcept {
    return tint_is_white_ && opacity(primitive, u, v) <= 0;
  }

 private:
  float cut(float opacity) const noexcept;

  const Object* object_;
  const Texture* texture_ = nullptr;  ///< of the opacity, if it varies
  int channel_ = 0;                   ///< of the texture
  float factor_ = 1;                  ///< of the texture's opacity
  float cutoff_ = -1;                 ///< as Material::cutoff
  float opacity_ = 1;                 ///< where there is no texture
  Rgb<float> tint_;
  bool tint_is_white_;
};

/// Where on an object's textures a point lies: u to the right, v up. (0, 0) for a mesh without such
/// coordinates.
std::array<float, 2> texture_coordinates(const Object& object, std::uint32_t primitive, float u,
                                         float v) noexcept;

/// Longitude and latitude of a sphere's outward normal (need not be unit), both in [0, 1]: u = 0
/// faces +x, u = 1/4 faces −z, v = 1 is the pole +y.
std::array<float, 2> sphere_coordinates(Vec3<float> normal) noexcept;

/// The unit normal that `sphere_coordinates` came from.
Vec3<float> sphere_normal(float u, float v) noexcept;

}  // namespace airlight
