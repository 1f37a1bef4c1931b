#pragma once
#include <airlight/describe.h>
#include <airlight/math/vec.h>

#include <optional>
#include <string>

#include "scene/cursor.h"
#include "scene/objects/files.h"
#include "scene/objects/parts.h"
#include "scene/required.h"
#include "scene/transform.h"

namespace airlight {

/// What every object of a scene file may say: its name and where it is put.
struct PlacedObject : Transform {
  std::string label;  ///< the key "name"; a kind has a name, too
  bool holdout = false;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = PlacedObject;
    field("name", &O::label, unit::none, any_number(), "what reports call it");
    Transform::describe_of<PlacedObject>(field);
    field("holdout", &O::holdout, unit::none, any_number(),
          "stands for a thing in the background's picture: it blocks and shadows, and the camera "
          "sees the background in its place, in the shadows of objects that are no holdouts");
  }

  /// Puts the parts where the keys say, names and marks them.
  void place(Parts& parts, const char* kind) const;
};

/// An object that may also say what its surface is like.
struct SurfacedObject : PlacedObject {
  std::optional<Rgb<double>> albedo;
  std::optional<std::string> albedo_texture;
  std::optional<double> opacity;
  std::optional<std::string> opacity_texture;
  std::optional<double> cutoff;
  std::optional<Rgb<double>> tint;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    PlacedObject::describe(field);
    using O = SurfacedObject;
    field("albedo", &O::albedo, unit::one, closed(0, 1),
          "what part of the light it reflects; 0.5 if nothing is said");
    field("albedo_texture", &O::albedo_texture, unit::none, any_number(),
          "picture that multiplies the albedo; its path starts at the scene file");
    field("opacity", &O::opacity, unit::one, closed(0, 1),
          "what part of the light it stops; 1 if nothing is said");
    field("opacity_texture", &O::opacity_texture, unit::none, any_number(),
          "picture that multiplies the opacity by its alpha or, without one, its red");
    field("cutoff", &O::cutoff, unit::one, closed(0, 1),
          "opacity below it counts as 0, from it on as 1");
    field("tint", &O::tint, unit::one, closed(0, 1), "colours the light it lets through");
  }

  /// Gives the parts what the keys say; what they do not say stays. Throws Error for a texture that
  /// cannot be read.
  void paint(Parts& parts, const Cursor& at, const Files& files) const;
};

}  // namespace airlight
