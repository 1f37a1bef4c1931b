#include "geometry/world.h"

#include <algorithm>
#include <cmath>

namespace airlight {

namespace {

std::vector<SurfaceFilter> filters_of(const Scene& scene) {
  std::vector<SurfaceFilter> filters;
  for (const Object& object : scene.objects) filters.emplace_back(scene, object);
  return filters;
}

}  // namespace

World::Surfaces::Surfaces(const Scene& scene, Visibility visibility,
                          std::span<const SurfaceFilter> filters, Among among) {
  if (visibility == Visibility::embree)
    embree.emplace(scene, filters, among);
  else
    exact.emplace(scene, among);
}

World::World(const Scene& scene, Visibility visibility)
    : scene_(&scene), surfaces_(filters_of(scene)), all_(scene, visibility, surfaces_, Among::all) {
  const auto holdouts = std::ranges::count(scene.objects, true, &Object::holdout);
  if (holdouts > 0 && holdouts < std::ssize(scene.objects))
    holdouts_.emplace(scene, visibility, surfaces_, Among::holdouts);
}

SurfacePoint World::surface(std::uint32_t object, std::uint32_t primitive, float u,
                            float v) const noexcept {
  const Object& what = scene_->objects[object];
  const Material& material = what.material;
  SurfacePoint point;
  point.object = object;
  point.holdout = what.holdout;
  if (const auto* mesh = std::get_if<Mesh>(&what.geometry)) {
    const auto [a, b, c] = mesh->triangles[primitive];
    const auto& p = mesh->positions;
    // In double: the sides of a small triangle far from the origin lose their digits in float.
    const Vec3<double> origin(p[a]);
    const Vec3<double> n = cross(Vec3<double>(p[b]) - origin, Vec3<double>(p[c]) - origin);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    point.geometric_normal = Vec3<float>(n * (1 / largest));
    point.normal = point.geometric_normal;
    if (!mesh->normals.empty()) {
      const auto& normals = mesh->normals;
      const Vec3<float> s = (1 - u - v) * normals[a] + u * normals[b] + v * normals[c];
      // Normals that cancel say nothing.
      if (dot(s, s) > 1e-12f) point.normal = s;
    }
  } else {
    point.geometric_normal = point.normal = sphere_direction(u, v);
  }
  point.albedo = Rgb<float>(material.albedo);
  if (material.albedo_texture >= 0) {
    const auto [s, t] = texture_coordinates(what, primitive, u, v);
    const auto texel = scene_->textures[std::size_t(material.albedo_texture)].sample(s, t);
    point.albedo *= Rgb<float>(texel[0], texel[1], texel[2]);
  }
  const SurfaceFilter& filter = surfaces_[object];
  point.opacity = filter.opacity(primitive, u, v);
  point.transmittance = filter.transmittance(primitive, u, v);
  return point;
}

}  // namespace airlight
