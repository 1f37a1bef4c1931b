#pragma once
#include <airlight/lights.h>

#include <optional>
#include <string>
#include <variant>

#include "scene/cross_section_documents.h"
#include "scene/cursor.h"
#include "scene/objects/files.h"
#include "scene/required.h"

namespace airlight {

/// What every kind of light can say: the group it belongs to.
struct GroupedLight {
  std::optional<std::string> group;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    field(
        "group", &GroupedLight::group, unit::none, any_number(),
        "lights of one group share a layer of the picture, which can be dimmed or coloured later; "
        "letters, digits, _ and -");
  }

  /// The group's name, empty without one. Throws Error unless it can be the name of a layer.
  std::string light_group(const Cursor& at) const;
};

/// A directional light as a file says it: its direction of travel, or where in the sky it stands.
struct DirectionalDocument : GroupedLight {
  Required<Rgb<double>> irradiance;
  std::optional<Vec3<double>> direction;
  std::optional<double> azimuth;
  std::optional<double> elevation;
  double angular_diameter = 0;

  static constexpr auto name = Directional::name;
  static constexpr auto meaning = Directional::meaning;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = DirectionalDocument;
    field("irradiance", &D::irradiance, unit::irradiance, at_least(0),
          "on a surface that faces the light, outside the medium");
    field("direction", &D::direction, unit::none, any_number(),
          "of travel, of any length; instead of azimuth and elevation");
    field("azimuth", &D::azimuth, unit::degree, closed(-360, 360),
          "where the light comes from, seen from above: 0 is north (-z), 90 east (+x)");
    field("elevation", &D::elevation, unit::degree, closed(-90, 90),
          "where the light comes from, above the horizon; 90 is straight down (up is +y)");
    field(
        "angular_diameter", &D::angular_diameter, unit::degree, Range{0, 90, false, true},
        "of the light's disc; the sun's is 0.53; 0 is parallel light. Each part of a disc gives "
        "its part of the irradiance to what faces that part; a flat surface that faces the middle "
        "of a wide disc gets less: a thousandth at 7 degrees, 7 % at 60");
    GroupedLight::describe(field);
  }

  /// Throws Error unless the direction is given in exactly one way.
  Directional light(const Cursor& at) const;
};

/// A beam as a file says it.
struct CollimatedDocument : GroupedLight {
  Required<Rgb<double>> irradiance;
  Required<Vec3<double>> position;
  std::optional<Vec3<double>> direction;
  std::optional<Vec3<double>> target;
  std::optional<Vec3<double>> up;
  Required<CrossSectionDocuments> cross_section;
  std::optional<std::string> image;

  static constexpr auto name = Collimated::name;
  static constexpr auto meaning = Collimated::meaning;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = CollimatedDocument;
    field("irradiance", &D::irradiance, unit::irradiance, at_least(0),
          "across the beam, where it starts");
    field("position", &D::position, unit::metre, any_number(),
          "the middle of the plane where the beam starts; nothing before it throws shadows");
    field("direction", &D::direction, unit::none, any_number(),
          "of travel, of any length; instead of target");
    field("target", &D::target, unit::metre, any_number(),
          "a point that the middle of the beam goes through; instead of direction");
    field("up", &D::up, unit::none, any_number(),
          "what is up in the cross-section and its image, not along the beam; if nothing is said, "
          "+y, or -z for a vertical beam");
    field("cross_section", &D::cross_section, unit::none, any_number(), "the outline of the beam");
    field("image", &D::image, unit::none, any_number(),
          "picture that filters the beam, stretched over the rectangle around the cross-section: "
          "black and transparent parts block, white passes, colours tint; its path starts at "
          "the scene file");
    GroupedLight::describe(field);
  }

  /// Throws Error unless the direction is given in exactly one way; for an image that cannot be
  /// read. The image becomes the last of the textures.
  Collimated light(const Cursor& at, const Files& files, std::vector<Texture>& textures) const;
};

/// Every kind of light as a file says it.
using LightDocuments = std::variant<DirectionalDocument, CollimatedDocument>;

}  // namespace airlight
