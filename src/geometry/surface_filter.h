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
/// sphere those of `sphere_point`. Keeps pointers to the scene's object and texture.
class SurfaceFilter {
 public:
  SurfaceFilter(const Scene& scene, const Object& object);

  /// Whether the object is a sphere.
  bool on_sphere() const noexcept { return on_sphere_; }
  /// Whether the opacity varies from point to point.
  bool varies() const noexcept { return texture_ != nullptr; }
  /// Whether no light passes anywhere.
  bool is_opaque() const noexcept { return !varies() && opacity_ >= 1; }
  /// Whether all light passes everywhere, unchanged: the surface cannot be seen either.
  bool is_clear() const noexcept { return !varies() && opacity_ <= 0 && tint_is_white_; }
  /// The same at one point.
  bool is_clear(std::uint32_t primitive, float u, float v) const noexcept {
    return tint_is_white_ && opacity(primitive, u, v) <= 0;
  }

  /// The part of the light that is held back, before the tint, in [0, 1].
  float opacity(std::uint32_t primitive, float u, float v) const noexcept;

  /// What light is multiplied by that crosses the surface, (1 − opacity) · tint, if it does not
  /// vary.
  Rgb<double> transmittance() const noexcept { return tint_ * (1 - opacity_); }
  /// The same at one point.
  Rgb<float> transmittance(std::uint32_t primitive, float u, float v) const noexcept {
    return Rgb<float>(tint_ * double(1 - opacity(primitive, u, v)));
  }

 private:
  double cut(double opacity) const noexcept;

  const Object* object_;
  bool on_sphere_;
  const Texture* texture_ = nullptr;  ///< of the opacity, if it varies
  std::size_t channel_ = 0;           ///< of the texture
  double opacity_ = 1;                ///< where it does not vary
  Rgb<double> tint_;
  bool tint_is_white_;
};

/// Where on an object's textures a point lies: u to the right, v up; on a sphere longitude and
/// latitude. (0, 0) for a mesh without such coordinates.
std::array<float, 2> texture_coordinates(const Object& object, std::uint32_t primitive, float u,
                                         float v) noexcept;

/// Where on a sphere the outward normal (x, y, z), which need not be unit, points: its place on the
/// octahedron |x| + |y| + |z| = 1, the lower half folded out, in [-1, 1]². Cheap both ways, as
/// every ray that meets a sphere asks. Plain numbers, because objects of every instruction set call
/// it, in which the core's types have different names.
std::array<float, 2> sphere_point(float x, float y, float z) noexcept;

/// The normal that `sphere_point` came from, of any length.
Vec3<float> sphere_direction(float u, float v) noexcept;

}  // namespace airlight
