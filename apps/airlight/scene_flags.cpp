#include "scene_flags.h"

#include <algorithm>

#include "error.h"
#include "flags.h"
#include "numbers.h"
#include "render/prepare.h"
#include "render/summary.h"

void SceneFlags::declare(CLI::App& verb, const std::vector<std::string>& without) {
  verb.add_option("SCENE", file_, "a scene (.toml) or a model (.obj, .gltf, .glb)")
      ->required()
      ->type_name("");
  verb.add_option_function<std::vector<std::string>>(
          "-D",
          [this](const std::vector<std::string>& assignments) {
            for (const std::string& assignment : assignments) changes_.emplace_back(assignment);
          },
          "changes a value of the scene: PATH=VALUE, as in lights.0.irradiance=3; may be repeated; "
          "files start at the current folder")
      ->type_name("")
      ->allow_extra_args(false)
      ->group("Scene");
  verb.add_option_function<std::string>(
          "--size",
          [this](const std::string& text) {
            const std::string said = "--size " + text;
            const auto size = whole_numbers(text, 'x');
            if (size.size() != 2)
              throw airlight::Error(
                  said + ": is no size; accepted: WIDTHxHEIGHT in pixels, such as 640x360");
            changes_.emplace_back("image.width", std::to_string(size[0]), said);
            changes_.emplace_back("image.height", std::to_string(size[1]), said);
          },
          "WIDTHxHEIGHT of the picture in pixels")
      ->type_name("")
      ->take_last()
      ->group("Scene");
  verb.add_option_function<std::string>(
          "--background",
          [this](const std::string& file) {
            changes_.emplace_back("background_image", airlight::toml_text(file),
                                  "--background " + file);
          },
          "a picture that stands behind everything, of the picture's proportions")
      ->type_name("FILE")
      ->take_last()
      ->group("Scene");
  add_flags<airlight::RenderSettings>(verb, "render.", "Render", changes_, without);
}

void SceneFlags::preset(const std::string& path, const std::string& value) {
  changes_.emplace(changes_.begin(), path, value, path + " = " + value);
}

airlight::Scene SceneFlags::load() const { return checked(airlight::load_scene(file_, changes_)); }

airlight::Scene SceneFlags::load(const airlight::SceneFile& file, std::int64_t frame) const {
  return checked(file.scene(frame));
}

airlight::SceneFile SceneFlags::open() const { return airlight::SceneFile(file_, changes_); }

std::string SceneFlags::said(const std::string& path) const {
  const auto change =
      std::ranges::find(changes_.rbegin(), changes_.rend(), path, &airlight::Override::path);
  return change == changes_.rend() ? "" : change->said;
}

airlight::Scene SceneFlags::checked(airlight::Scene scene) const {
  try {
    airlight::estimator_for(scene.render);
  } catch (const airlight::Error& error) {
    const std::string flag = said("render.estimator");
    throw airlight::Error((flag.empty() ? "" : flag + ": ") + error.what());
  }
  return scene;
}

void SceneFlags::tell(const airlight::Scene& scene) {
  if (!scene.assumptions.empty()) fmt::print(stderr, "{}\n", fmt::join(scene.assumptions, "; "));
  for (const std::string& warning : airlight::warnings_before(scene))
    fmt::print(stderr, "warning: {}\n", warning);
}
