#include "study/reproductions/000/black_ball.h"

#include <algorithm>
#include <cctype>
#include <numbers>

namespace airlight::paper_000 {

std::string upper_case(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return name;
}

Scene black_ball(const Configuration& configuration) {
  Scene scene;
  scene.resolution = {256, 256};
  scene.camera.position = configuration.eye;
  scene.camera.fov = configuration.fov;
  Medium fog;
  fog.sigma_s = fog.sigma_t = Rgb<double>(configuration.sigma_t);
  scene.media = {fog};
  Directional light;
  light.irradiance =
      Rgb<double>(configuration.strength * 4 * std::numbers::pi / configuration.sigma_t);
  light.direction = -normalize(configuration.toward);
  scene.lights = {light};
  Material black;
  black.albedo = {0, 0, 0};
  scene.objects = {{"ball", Sphere{{0, 0, 0}, ball_radius}, black}};
  scene.render.samples_per_ray = 0;
  scene.render.visibility = Visibility::analytic;
  return scene;
}

Scene black_ball_many_times() {
  Scene scene = black_ball(configurations[0]);
  scene.resolution = {48, 48};
  scene.media[0].sigma_s = scene.media[0].sigma_t * 0.86;
  std::get<Directional>(scene.lights[0]).irradiance = Rgb<double>(14.52);
  scene.render.max_depth = 12;
  scene.render.continuation = Continuation::sample;
  return scene;
}

}  // namespace airlight::paper_000
