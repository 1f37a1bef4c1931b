#include "render/traits.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "render/hash.h"
#include "render/prepare.h"
#include "scene/reference.h"

namespace airlight {
namespace {

/// The members of a struct that no `describe` tells. A binding names all of them, so that a new
/// member does not compile until somebody has decided here what becomes of it.
auto members(const Directional& light) {
  const auto& [irradiance, direction, angular_diameter] = light;
  return std::tie(irradiance, direction, angular_diameter);
}
auto members(const CrossSection& outline) {
  const auto& [radius, side_count, sides, low, high] = outline;
  return std::tie(radius, side_count, sides, low, high);
}
auto members(const CrossSection::Side& side) {
  const auto& [x, y, h] = side;
  return std::tie(x, y, h);
}
auto members(const Collimated& light) {
  const auto& [irradiance, position, direction, right, up, cross_section, image] = light;
  return std::tie(irradiance, position, direction, right, up, cross_section, image);
}
auto members(const Vec2<double>& v) {
  const auto& [x, y] = v;
  return std::tie(x, y);
}
auto members(const Plane& plane) {
  const auto& [n, h] = plane;
  return std::tie(n, h);
}
auto members(const Convex& shape) {
  const auto& [faces, face_count, centre] = shape;
  return std::tie(faces, face_count, centre);
}
auto members(const ClosedMesh& mesh) {
  const auto& [corners, triangles, centre, tree] = mesh;
  return std::tie(corners, triangles, centre);  // the tree follows from them
}
auto members(const Solid& solid) {
  const auto& [mesh] = solid;
  return std::tie(*mesh);
}
auto members(const Medium& medium) {
  const auto& [sigma_s, sigma_t, emission, phase, shape] = medium;
  return std::tie(sigma_s, sigma_t, emission, phase, shape);
}
auto members(const Texture& texture) {
  const auto& [width, height, rgba, srgb, wrap_u, wrap_v] = texture;
  return std::tie(width, height, rgba, srgb, wrap_u, wrap_v);
}
auto members(const Image& image) {
  const auto& [width, height, channels, pixels] = image;
  return std::tie(width, height, channels, pixels);
}
auto members(const Material& m) {
  const auto& [albedo, albedo_texture, opacity, opacity_texture, from_alpha, cutoff, tint] = m;
  return std::tie(albedo, albedo_texture, opacity, opacity_texture, from_alpha, cutoff, tint);
}
auto members(const Mesh& mesh) {
  const auto& [positions, normals, uvs, triangles] = mesh;
  return std::tie(positions, normals, uvs, triangles);
}
auto members(const Sphere& sphere) {
  const auto& [centre, radius] = sphere;
  return std::tie(centre, radius);
}
auto members(const Object& object) {
  const auto& [name, geometry, material, holdout] = object;
  return std::tie(geometry, material, holdout);  // a name is told, not seen
}

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<Vec3<T>> = true;
template <class T>
constexpr bool is_vector<Rgb<T>> = true;

template <class T>
concept Bulk = std::ranges::contiguous_range<T> &&
    (std::is_arithmetic_v<std::ranges::range_value_t<T>> ||
     is_vector<std::ranges::range_value_t<T>>);

/// Adds anything that a scene is made of.
template <class T>
void add(Hash& hash, const T& value) {
  if constexpr (Bulk<T>) {  // also texts
    hash.add(std::as_bytes(std::span(value)));
  } else if constexpr (std::ranges::range<T>) {
    hash.add(std::uint64_t(std::ranges::size(value)));
    for (const auto& element : value) add(hash, element);
  } else if constexpr (std::is_floating_point_v<T>) {
    hash.add(std::bit_cast<std::uint64_t>(double(value)));
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    hash.add(std::uint64_t(value));
  } else if constexpr (is_vector<T>) {
    for (int i = 0; i < 3; ++i) add(hash, value[i]);
  } else if constexpr (is_optional<T>) {
    add(hash, value.has_value());
    if (value) add(hash, *value);
  } else if constexpr (is_family<T>) {
    add(hash, value.index());
    std::visit([&](const auto& member) { add(hash, member); }, value);
  } else if constexpr (Described<T>) {
    T::describe([&](const char*, auto member, auto&&...) { add(hash, value.*member); });
  } else {
    std::apply([&](const auto&... member) { (add(hash, member), ...); }, members(value));
  }
}

template <class... Parts>
std::string hash_of(const Parts&... parts) {
  Hash hash;
  (add(hash, parts), ...);
  return fmt::format("#{:016x}", hash.value());
}

/// A setting as a file says it, but without quotes.
template <class T>
std::string text_of(const T& value) {
  const std::string text = default_text(value);
  return text.starts_with('"') ? text.substr(1, text.size() - 2) : text;
}

/// Settings that leave the sums as they are, but for rounding, or that say which samples to add.
const std::vector<std::string> no_trait = {"spp", "seed", "first_sample", "isa", "threads"};

}  // namespace

Traits traits_of(const Scene& scene, const RenderSettings& settings) {
  const auto& [camera, resolution, background, background_image, background_is_seen, ambient,
               textures, objects, media, lights, light_groups, unused_settings, assumptions] =
      scene;
  const bool has_background = !background_image.pixels.empty() || background != Rgb<double>();
  Traits traits = {
      {"image", fmt::format("{} x {}", resolution.width, resolution.height)},
      {"camera", hash_of(camera)},
      {"background", hash_of(background, background_image)},
      {what_is_behind, has_background && background_is_seen ? "shown" : "left out"},
      {"ambient", hash_of(ambient)},
      {"media", hash_of(media)},
      {"lights", hash_of(lights, light_groups)},
      {"objects", hash_of(objects)},
      {"textures", hash_of(textures)},
  };
  RenderSettings::describe([&](const std::string& key, auto member, auto&&...) {
    if (std::ranges::find(no_trait, key) != no_trait.end()) return;
    traits.emplace_back("render." + key, text_of(settings.*member));
  });
  if (goes_through_centre(settings))
    std::ranges::find(traits, "render.samples_per_ray", &Traits::value_type::first)->second = "all";
  return traits;
}

std::string difference(const Traits& found, const Traits& wanted) {
  for (const auto& [name, value] : wanted) {
    const std::string other = value_of(found, name);
    if (other == value) continue;
    if (other.empty()) return name + " is not told";
    return value.starts_with('#') ? "not the same " + name
                                  : fmt::format("{} is {}, not {}", name, other, value);
  }
  return found.size() == wanted.size() ? "" : "it has settings that are not known here";
}

std::string value_of(const Traits& traits, const std::string& name) {
  const auto found = std::ranges::find(traits, name, &Traits::value_type::first);
  return found == traits.end() ? "" : found->second;
}

}  // namespace airlight
