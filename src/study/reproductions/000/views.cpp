#include "study/reproductions/000/views.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/load_scene.h"
#include "study/scene_texts.h"

namespace airlight::paper_000 {

namespace {

bool is_coloured(const Rgb<double>& c) { return c.r != c.g || c.g != c.b; }

/// The mean of the channels in each.
Rgb<double> grey(const Rgb<double>& c) { return Rgb<double>((c.r + c.g + c.b) / 3); }

}  // namespace

View view(std::string name, std::string stem, std::string about, Scene scene, int width) {
  bool had_disc = false, had_colours = false;
  const Resolution was = scene.resolution;
  scene.resolution = {width, std::max(1, int(std::lround(double(width) * was.height / was.width)))};
  for (Lights& light : scene.lights)
    if (auto* sun = std::get_if<Directional>(&light)) {
      had_disc |= sun->angular_diameter > 0;
      sun->angular_diameter = 0;
    }
  for (Medium& medium : scene.media)
    for (Rgb<double>* coefficient : {&medium.sigma_s, &medium.sigma_t}) {
      had_colours |= is_coloured(*coefficient);
      *coefficient = grey(*coefficient);
    }
  if (had_disc || had_colours)
    about += fmt::format(" As in the paper, {}{}{} here.", had_disc ? "sunlight is parallel" : "",
                         had_disc && had_colours ? " and " : "", had_colours ? "fog is grey" : "");
  scene.background_image = {};  // would have to be of the picture's size
  scene.render.samples_per_ray = 0;
  scene.render.first_sample.reset();
  return {std::move(name), std::move(stem), std::move(about), std::move(scene)};
}

View from_the_dark(int width) {
  return view("The sunroom as it is", "dark",
              "`scenes/sunroom.toml`: thin fog, seen from the dark end of the room; the shafts of "
              "light are far from the camera.",
              parse_scene(sunroom_toml, "scenes/sunroom.toml"), width);
}

View in_the_light(int width) {
  return view("The sunroom in thicker fog, beside the windows", "light",
              "`scenes/sunroom.toml` with σ_{s} = 0.5 /m, from (6.6, 2.2, 7.6) m towards "
              "(1.5, 0.8, 3): the camera stands in the light, and what is lit is near.",
              parse_scene(sunroom_toml, "scenes/sunroom.toml",
                          {"media.0.sigma_s=0.5", "camera.position=[6.6, 2.2, 7.6]",
                           "camera.target=[1.5, 0.8, 3]"}),
              width);
}

View ball_in_fog(const Configuration& configuration, int width) {
  Scene scene = black_ball(configuration);
  scene.render.visibility = Visibility::embree;
  return view(fmt::format("The ball in fog of figure 6, {}", configuration.name), "ball",
              fmt::format("Configuration {} of 000/fig6-single: a black ball in a cube of fog.",
                          configuration.name),
              std::move(scene), width);
}

View given_view(const Reproduced& out, int width) {
  Scene scene = load_scene(out.scene_file);
  const std::string name = out.scene_file.filename().string();
  std::string about = fmt::format("`{}`", name);
  for (const std::string& assumption : scene.assumptions) about += "; " + assumption;
  return view(name, "scene", about + ".", std::move(scene), width);
}

}  // namespace airlight::paper_000
