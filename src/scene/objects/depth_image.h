#pragma once
#include "scene/objects/files.h"
#include "scene/objects/keys.h"
#include "scene/objects/view.h"

namespace airlight {

enum class DepthMeasure { axis, ray };

template <>
inline constexpr Word<DepthMeasure> words<DepthMeasure>[] = {
    {"axis", DepthMeasure::axis, "along the view axis, as depth cameras tell it"},
    {"ray", DepthMeasure::ray, "from the camera, as the layer depth of a render is"},
};

/// A real place as a depth camera or a render saw it.
struct DepthImageObject : SurfacedObject {
  Required<std::string> file;
  std::string channel;
  std::optional<double> unit;
  DepthMeasure measure = DepthMeasure::axis;
  double discontinuity = 0.1;
  std::optional<double> farthest;
  std::optional<Camera> camera;

  static constexpr auto name = "depth_image";
  static constexpr auto meaning =
      "the surfaces of a place that its depth image tells, usually a holdout before its photograph";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = DepthImageObject;
    field("file", &O::file, unit::none, any_number(),
          "one depth a pixel (.exr, .pfm, grey .png); its path starts at the scene file; what is "
          "not above 0, or no number, says that nothing is there");
    field("channel", &O::channel, unit::none, any_number(),
          "of an EXR; if nothing is said its only one, or Z, or depth.Z");
    field("unit", &O::unit, unit::metre, above(0),
          "what 1 in the file stands for; 1 if nothing is said, but a PNG needs it");
    field("measure", &O::measure, unit::none, any_number(), "which way depths go");
    field("discontinuity", &O::discontinuity, unit::one, above(0),
          "pixels whose depths differ by a larger part are not joined by a surface");
    field("farthest", &O::farthest, unit::metre, above(0),
          "depths from this one on say that nothing is there, such as the sky");
    field("camera", &O::camera, unit::none, any_number(),
          "what saw it, its picture as wide and high as the file; the scene's if nothing is said");
    SurfacedObject::describe(field);
  }

  /// Throws Error if the file cannot be read, has no depths, or other proportions than the picture
  /// of the scene's camera.
  Parts build(const Cursor& at, const Files& files, const View& view) const;
};

}  // namespace airlight
