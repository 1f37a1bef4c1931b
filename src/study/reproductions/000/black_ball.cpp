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

Scene black_ball_many_times(const Configuration& configuration) {
  Scene scene = black_ball(configuration);
  scene.resolution = {48, 48};
  scene.media[0].sigma_s = scene.media[0].sigma_t * configuration.many_times.albedo;
  std::get<Directional>(scene.lights[0]).irradiance =
      Rgb<double>(configuration.many_times.irradiance);
  scene.render.max_depth = 12;
  scene.render.continuation = Continuation::sample;
  return scene;
}

}  // namespace airlight::paper_000
