#include "surface_filter.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace airlight {

SurfaceFilter::SurfaceFilter(const Scene& scene, const Object& object)
    : object_(&object),
      tint_(object.material.tint),
      tint_is_white_(object.material.tint == Rgb<double>(1.0)) {
  const Material& material = object.material;
  cutoff_ = float(material.cutoff);
  factor_ = float(material.opacity);
  if (material.opacity_texture < 0) {
    opacity_ = cut(factor_);
    return;
  }
  texture_ = &scene.textures[std::size_t(material.opacity_texture)];
  channel_ = material.opacity_from_alpha ? 3 : 0;
  // Models are full of leaves' textures on things without holes: those need not be looked up ray by
  // ray.
  const std::size_t texels = std::size_t(texture_->width) * std::size_t(texture_->height);
  bool full = true;
  for (std::size_t i = 0; i < texels && full; ++i)
    full = texture_->rgba[4 * i + std::size_t(channel_)] == 255;
  if (full) {
    opacity_ = cut(factor_);
    texture_ = nullptr;
  }
}

float SurfaceFilter::cut(float opacity) const noexcept {
  if (cutoff_ < 0) return std::clamp(opacity, 0.f, 1.f);
  return opacity < cutoff_ ? 0.f : 1.f;
}

float SurfaceFilter::opacity(std::uint32_t primitive, float u, float v) const noexcept {
  if (texture_ == nullptr) return opacity_;
  const auto [s, t] = texture_coordinates(*object_, primitive, u, v);
  return cut(factor_ * texture_->sample(s, t)[std::size_t(channel_)]);
}

std::array<float, 2> texture_coordinates(const Object& object, std::uint32_t primitive, float u,
                                         float v) noexcept {
  const auto* mesh = std::get_if<Mesh>(&object.geometry);
  if (mesh == nullptr) return {u, v};
  if (mesh->uvs.empty()) return {0, 0};
  const auto& triangle = mesh->triangles[primitive];
  const auto &a = mesh->uvs[triangle[0]], &b = mesh->uvs[triangle[1]], &c = mesh->uvs[triangle[2]];
  const float w = 1 - u - v;
  return {w * a[0] + u * b[0] + v * c[0], w * a[1] + u * b[1] + v * c[1]};
}

std::array<float, 2> sphere_coordinates(Vec3<float> n) noexcept {
  const float turn = std::atan2(-n.z, n.x) * float(0.5 / pi);
  return {turn < 0 ? turn + 1 : turn,
          0.5f + std::atan2(n.y, std::sqrt(n.x * n.x + n.z * n.z)) * float(1 / pi)};
}

Vec3<float> sphere_normal(float u, float v) noexcept {
  const float longitude = u * float(2 * pi), latitude = (v - 0.5f) * float(pi);
  const float ring = std::cos(latitude);
  return {ring * std::cos(longitude), std::sin(latitude), -ring * std::sin(longitude)};
}

}  // namespace airlight
