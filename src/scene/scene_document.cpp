#include "scene/scene_document.h"

#include <airlight/never_arrives.h>
#include <fmt/format.h>

#include <bit>

#include "image/numbered.h"
#include "scene/background_image.h"
#include "scene/camera.h"
#include "scene/joined_media.h"
#include "scene/reader.h"

namespace airlight {
namespace {

void check(const RenderSettings& render, const Cursor& at) {
  if (render.samples_per_ray > 0 && !std::has_single_bit(std::uint64_t(render.samples_per_ray)))
    at.at_or_here("samples_per_ray").refuse("is not accepted: a power of two, or 0 for all");
}

/// Adds an object's parts to the scene.
void add(Parts parts, Scene& scene) {
  const int first = int(scene.textures.size());
  for (Texture& texture : parts.textures) scene.textures.push_back(std::move(texture));
  for (Object& object : parts.objects) {
    if (object.material.albedo_texture >= 0) object.material.albedo_texture += first;
    if (object.material.opacity_texture >= 0) object.material.opacity_texture += first;
    scene.objects.push_back(std::move(object));
  }
  for (std::string& remark : parts.remarks) scene.assumptions.push_back(std::move(remark));
}

Parts parts_of(const Objects& objects, const Cursor& at, const Files& files, const View& view) {
  return std::visit(
      [&](const auto& object) {
        Parts parts;
        if constexpr (requires { object.build(at, files, view); })
          parts = object.build(at, files, view);
        else if constexpr (requires { object.build(at, files); })
          parts = object.build(at, files);
        else
          parts = object.build(at);
        if constexpr (requires { object.paint(parts, at, files); }) object.paint(parts, at, files);
        object.place(parts, object.name);
        return parts;
      },
      objects);
}

/// The picture behind the scene at its frame.
std::filesystem::path plate_of(const SceneDocument& document, const Cursor& at,
                               const Files& files) {
  return numbered(files.path(*document.background_image, at), document.render.frame);
}

/// Combinations that each part of the scene accepts by itself.
void check_together(const Scene& scene, const Cursor& at) {
  for (std::size_t i = 0; i < scene.media.size(); ++i)
    for (const Lights& light : scene.lights)
      if (const char* reason = never_arrives(scene.media[i], light))
        at.at_or_here("media").element(i).at_or_here("shape").complain(
            fmt::format("does not fit the lights: {}", reason));
}

}  // namespace

SceneDocument read_scene_document(const Value& value) {
  SceneDocument document;
  read_table(Cursor(value), document);
  return document;
}

void check_without_files(const SceneDocument& document, const Value& value) {
  const Cursor at(value);
  check_camera(document.camera, at.at_or_here("camera"));
  check(document.render, at.at_or_here("render"));
  std::vector<Medium> media;
  for (std::size_t i = 0; i < document.media.size(); ++i)
    if (!std::holds_alternative<SolidDocument>(*document.media[i].shape))
      media.push_back(document.media[i].medium(at.at_or_here("media").element(i), {}));
  if (media.size() < document.media.size()) return;  // a mesh lies beside no other medium
  if (const auto reason = cannot_be_joined(media)) at.at_or_here("media").complain(*reason);
}

void check_plate(const SceneDocument& document, const Value& value, const Files& files) {
  if (!document.background_image) return;
  const Cursor at = Cursor(value).at_or_here("background_image");
  const std::filesystem::path plate = plate_of(document, at, files);
  if (!std::filesystem::exists(plate))
    at.complain("names a picture that is not there: " + plate.string());
}

Scene scene_of(const Value& value, const Files& files) {
  const Cursor at(value);
  const SceneDocument document = read_scene_document(value);

  Scene scene;
  scene.camera = document.camera;
  scene.resolution = document.image;
  scene.background = document.background;
  if (document.background_image) {
    const Cursor here = at.at_or_here("background_image");
    scene.background_image = load_background_image(plate_of(document, here, files),
                                                   scene.resolution, here, scene.assumptions);
  }
  scene.ambient = document.ambient;
  scene.render = document.render;
  check_camera(scene.camera, at.at_or_here("camera"));
  check(scene.render, at.at_or_here("render"));
  for (std::size_t i = 0; i < document.media.size(); ++i)
    scene.media.push_back(document.media[i].medium(at.at_or_here("media").element(i), files));
  for (std::size_t i = 0; i < document.lights.size(); ++i)
    std::visit(
        [&](const auto& light) {
          const Cursor here = at.at_or_here("lights").element(i);
          if constexpr (requires { light.light(here, files, scene.textures); })
            scene.lights.push_back(light.light(here, files, scene.textures));
          else
            scene.lights.push_back(light.light(here));
          scene.light_groups.push_back(light.light_group(here));
        },
        document.lights[i]);
  for (std::size_t i = 0; i < document.objects.size(); ++i)
    add(parts_of(document.objects[i], at.at_or_here("objects").element(i), files,
                 {scene.camera, scene.resolution}),
        scene);
  check_together(scene, at);
  if (const auto reason = cannot_be_joined(scene.media)) at.at_or_here("media").complain(*reason);
  return scene;
}

}  // namespace airlight
