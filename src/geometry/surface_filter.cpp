#include "geometry/surface_filter.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace airlight {

SurfaceFilter::SurfaceFilter(const Scene& scene, const Object& object)
    : object_(&object),
      on_sphere_(std::holds_alternative<Sphere>(object.geometry)),
      tint_(object.material.tint),
      tint_is_white_(object.material.tint == Rgb<double>(1.0)) {
  const Material& material = object.material;
  opacity_ = cut(material.opacity);
  if (material.opacity_texture < 0) return;

  const Texture& texture = scene.textures[std::size_t(material.opacity_texture)];
  channel_ = material.opacity_from_alpha ? 3 : 0;
  // Models give pictures with an alpha channel to things without holes: rays need not look there.
  for (std::size_t i = channel_; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] != 255) texture_ = &texture;
}

double SurfaceFilter::cut(double opacity) const noexcept {
  const double cutoff = object_->material.cutoff;
  if (cutoff < 0) return std::clamp(opacity, 0.0, 1.0);
  return opacity < cutoff ? 0 : 1;
}

float SurfaceFilter::opacity(std::uint32_t primitive, float u, float v) const noexcept {
  if (!varies()) return float(opacity_);
  const auto [s, t] = texture_coordinates(*object_, primitive, u, v);
  return float(cut(object_->material.opacity * double(texture_->sample(s, t, channel_))));
}

namespace {

/// Of a normal, both in [0, 1]: u = 0 faces +x, u = 1/4 faces −z, v = 1 is the pole +y.
std::array<float, 2> longitude_and_latitude(Vec3<float> n) noexcept {
  const float turn = std::atan2(-n.z, n.x) * float(0.5 / pi);
  return {turn < 0 ? turn + 1 : turn,
          0.5f + std::atan2(n.y, std::sqrt(n.x * n.x + n.z * n.z)) * float(1 / pi)};
}

}  // namespace

std::array<float, 2> texture_coordinates(const Object& object, std::uint32_t primitive, float u,
                                         float v) noexcept {
  const auto* mesh = std::get_if<Mesh>(&object.geometry);
  if (mesh == nullptr) return longitude_and_latitude(sphere_direction(u, v));
  if (mesh->uvs.empty()) return {0, 0};
  const auto& triangle = mesh->triangles[primitive];
  const auto &a = mesh->uvs[triangle[0]], &b = mesh->uvs[triangle[1]], &c = mesh->uvs[triangle[2]];
  const float w = 1 - u - v;
  return {w * a[0] + u * b[0] + v * c[0], w * a[1] + u * b[1] + v * c[1]};
}

std::array<float, 2> sphere_point(float x, float y, float z) noexcept {
  const float scale = 1 / (std::abs(x) + std::abs(y) + std::abs(z));
  const float u = x * scale, v = y * scale;
  if (z >= 0) return {u, v};
  return {std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v)};
}

Vec3<float> sphere_direction(float u, float v) noexcept {
  const float z = 1 - std::abs(u) - std::abs(v);
  if (z >= 0) return {u, v, z};
  return {std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z};
}

}  // namespace airlight
