#pragma once
#include <vector>

#include "scene/animation.h"
#include "scene/light_documents.h"
#include "scene/medium_document.h"
#include "scene/objects.h"
#include "scene/scene.h"

namespace airlight {

/// A scene as a file says it: its top level.
struct SceneDocument {
  Camera camera;
  Resolution image;
  Rgb<double> background{0, 0, 0};
  std::optional<std::string> background_image;
  Rgb<double> ambient{0, 0, 0};
  std::vector<MediumDocument> media;
  std::vector<LightDocuments> lights;
  std::vector<Objects> objects;
  RenderSettings render;
  std::vector<AnimationDocument> animation;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = SceneDocument;
    field("background", &D::background, unit::radiance, at_least(0), "seen behind everything");
    field("background_image", &D::background_image, unit::none, any_number(),
          "a picture of the same proportions (.png, .jpg, .hdr, .exr, .pfm) that is seen behind "
          "everything instead, pixel by pixel; its path starts at the scene file");
    field("ambient", &D::ambient, unit::radiance, at_least(0),
          "light from all around; it reaches surfaces only, not the medium");
    field("camera", &D::camera, unit::none, any_number(), "a pinhole camera");
    field("image", &D::image, unit::none, any_number(), "the size of the picture");
    field("media", &D::media, unit::none, any_number(),
          "fog, dust, smoke or water; several lie side by side");
    field("lights", &D::lights, unit::none, any_number(), "any number of lights");
    field("objects", &D::objects, unit::none, any_number(),
          "what light meets, in the file's order");
    field("render", &D::render, unit::none, any_number(), "how the picture is made");
    field("animation", &D::animation, unit::none, any_number(),
          "values that change from frame to frame");
  }
};

/// Reads the text alone, no file that it names. Throws Error as `scene_of` does.
SceneDocument read_scene_document(const Value& document);

/// Throws Error for what is wrong with a document, beyond its values, and can be told without the
/// files that it names: its camera, its settings, media that overlap.
void check_without_files(const SceneDocument& document, const Value& value);

/// Throws Error if there is no file where the picture behind the scene should be at its frame.
void check_plate(const SceneDocument& document, const Value& value, const Files& files);

/// What a document means. Throws Error, one line, for everything that cannot be accepted.
Scene scene_of(const Value& document, const Files& files);

}  // namespace airlight
