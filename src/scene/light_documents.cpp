#include "scene/light_documents.h"

#include <algorithm>
#include <cctype>

#include "scene/accepted.h"
#include "scene/direction.h"
#include "scene/named_texture.h"
#include "scene/ways.h"

namespace airlight {
namespace {

/// Layers that a picture has anyway.
const std::vector<std::string> taken = {
    "albedo",       "alpha",          "analytic", "beauty",        "depth",     "holdout_plate",
    "holdout_seen", "in_scatter",     "normal",   "object",        "occluded",  "plain",
    "shadow",       "standard_error", "surface",  "transmittance", "ungrouped", "unoccluded"};

constexpr std::size_t longest_group = 64;  // an EXR file has room for 255 with channel and layer

}  // namespace

std::string GroupedLight::light_group(const Cursor& at) const {
  if (!group) return "";
  const auto fits = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  };
  if (group->empty() || group->size() > longest_group || !std::ranges::all_of(*group, fits))
    at.at_or_here("group").refuse("is no name of a group: up to 64 letters, digits, _ and -");
  if (std::ranges::find(taken, *group) != taken.end())
    at.at_or_here("group").refuse("is a layer that every picture has; accepted: all names but " +
                                  accepted_words(taken));
  return *group;
}

Directional DirectionalDocument::light(const Cursor& at) const {
  Directional light;
  light.irradiance = *irradiance;
  light.angular_diameter = angular_diameter;
  if (way_taken(at, {{"direction"}, {"azimuth", "elevation"}}) == 1) {
    light.direction = -toward_sky(*azimuth, *elevation);
    return light;
  }
  const auto unit = unit_vector(*direction);
  if (!unit)
    at.at_or_here("direction").refuse("is no direction: at least one number must not be 0");
  light.direction = *unit;
  return light;
}

Collimated CollimatedDocument::light(const Cursor& at, const Files& files,
                                     std::vector<Texture>& textures) const {
  Collimated beam;
  beam.irradiance = *irradiance;
  beam.position = *position;
  const bool has_direction = way_taken(at, {{"direction"}, {"target"}}) == 0;
  const auto travel = unit_vector(has_direction ? *direction : *target - *position);
  if (!travel && has_direction)
    at.at_or_here("direction").refuse("is no direction: at least one number must not be 0");
  if (!travel)
    at.at_or_here("target").refuse("is the light's own position; accepted: any other point");
  beam.direction = *travel;

  constexpr double all_but_parallel = 1e-6;
  Vec3<double> upward = up.value_or(Vec3<double>(0, 1, 0));
  if (up) {
    const auto unit = unit_vector(*up);
    if (!unit) at.at_or_here("up").refuse("is no direction: at least one number must not be 0");
    upward = *unit;
    if (length(cross(beam.direction, upward)) < all_but_parallel)
      at.at_or_here("up").refuse("is parallel to the beam; accepted: any other direction");
  } else if (length(cross(beam.direction, upward)) < all_but_parallel) {
    upward = {0, 0, -1};
  }
  beam.right = normalize(cross(beam.direction, upward));
  beam.up = cross(beam.right, beam.direction);

  beam.cross_section = cross_section_of(*cross_section, at.at_or_here("cross_section"));
  if (image) {
    Texture texture = named_texture(*image, at.at_or_here("image"), files);
    texture.wrap_u = texture.wrap_v = Wrap::clamp;
    beam.image = int(textures.size());
    textures.push_back(std::move(texture));
  }
  return beam;
}

}  // namespace airlight
