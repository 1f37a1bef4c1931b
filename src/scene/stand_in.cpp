#include "scene/stand_in.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/bounds.h"
#include "scene/direction.h"
#include "scene/look_around.h"
#include "scene/room_view.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;

/// Where the sun stands, in degrees as in a scene file.
struct Sun {
  double azimuth, elevation;
};

/// What to make of a model that says nothing.
struct View {
  bool is_room;
  Camera camera;
  Sun sun;
  Bounds fog;
};

std::string exact(Vec v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// For a sentence.
std::string text(Vec v) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x, v.y, v.z); }

/// From outside and above, the sun to the side: half of what stands there is lit, and its shadow in
/// the fog is seen from the side.
View outside_view(const Bounds& bounds) {
  constexpr double azimuth = 25, elevation = 15, fov = 40;
  const double radius = std::max(0.5 * length(bounds.size()), 1e-3);
  const Vec centre = bounds.centre();
  const double distance = 1.15 * radius / std::sin(0.5 * fov * pi / 180);
  const Vec margin = Vec{1, 1, 1} * (0.25 * radius);
  const Camera camera{
      centre + toward_sky(180 - azimuth, elevation) * distance, centre, {0, 1, 0}, fov};
  return {false, camera, {70, 40}, {bounds.min - margin, bounds.max + margin}};
}

/// The direction towards the model's own sun.
std::optional<Vec> sun_of(const Model& model) {
  if (model.lights.empty()) return std::nullopt;
  return model.lights[0].toward();
}

/// A room shows the front of its surfaces all around to someone in its middle, as a valley does,
/// too, but its roof takes more than half of the sky's light.
View view_of(const Model& model) {
  const Bounds bounds = bounds_of(model.objects);
  const Panorama middle = look_around(model.objects, {bounds.centre()})[0];
  if (middle.enclosed() < 0.7 || light_of_the_sky(model.objects, bounds.centre()) > 0.5)
    return outside_view(bounds);
  const RoomView inside = room_view(model.objects, middle, bounds, model.camera, sun_of(model));
  return {true, inside.camera, {inside.azimuth, inside.elevation}, inside.room};
}

std::string camera_table(const Camera& camera) {
  return fmt::format("[camera]\nposition = {}\ntarget = {}\nup = {}\nfov = {}\n",
                     exact(camera.position), exact(camera.target), exact(camera.up), camera.fov);
}

std::string light_table(const Directional& light) {
  const auto& [r, g, b] = light.irradiance;
  const Vec d = light.direction;
  return fmt::format(
      "[[lights]]\ntype = \"directional\"\nirradiance = [{}, {}, {}]\ndirection = [{}, {}, {}]\n"
      "angular_diameter = {}\n",
      r, g, b, d.x, d.y, d.z, light.angular_diameter);
}

/// Bright for a room, where little of it comes in.
std::string sun_table(const View& view) {
  return fmt::format(
      "[[lights]]\ntype = \"directional\"\nirradiance = {}\nazimuth = {:.0f}\n"
      "elevation = {:.0f}\nangular_diameter = 0.53\n",
      view.is_room ? "[22, 19, 15]" : "[8, 7, 5.6]", view.sun.azimuth, view.sun.elevation);
}

/// Fog that dims by more than half across the box.
std::string fog_table(const Bounds& box) {
  return fmt::format(
      "[[media]]\nalbedo = 0.97\nsigma_t = {:.3g}\nphase = {{type = \"henyey-greenstein\", g = "
      "0.4}}\nshape = {{type = \"box\", min = {}, max = {}}}\n",
      1.0 / length(box.size()), exact(box.min), exact(box.max));
}

}  // namespace

StandIn::StandIn(const Model& model, const std::string& file) {
  const View view = view_of(model);
  // A bright sky for the windows of a room; behind a thing a dim one, before which lit fog shows.
  sky_ = view.is_room ? "background = [0.9, 1.05, 1.3]\nambient = [0.1, 0.105, 0.12]\n"
                      : "background = [0.04, 0.05, 0.07]\nambient = [0.1, 0.11, 0.13]\n";
  // Few shafts make much noise: more samples than where a scene file says how many.
  sky_ += "[render]\nspp = 128\n";
  camera_ = camera_table(view.camera);
  if (!model.camera)
    assumed_.push_back({{"camera.position"},
                        fmt::format("a camera {} at {}", view.is_room ? "in the room" : "outside",
                                    text(view.camera.position))});
  sun_ = sun_table(view);
  if (model.lights.empty()) {
    const std::string direction = "lights.0.direction";
    assumed_.push_back({{"lights.0.azimuth", direction},
                        fmt::format("a sun at azimuth {:.0f}", view.sun.azimuth)});
    assumed_.push_back({{"lights.0.elevation", direction},
                        fmt::format("a sun at elevation {:.0f}", view.sun.elevation)});
  }
  assumed_.push_back({{"media.0.shape"},
                      fmt::format("fog from {} to {}", text(view.fog.min), text(view.fog.max))});
  assumed_.push_back({{"background", "ambient"}, "light of the sky"});
  rest_ = fog_table(view.fog) +
          fmt::format("[[objects]]\ntype = \"mesh\"\nfile = {}\n", toml_text(file));
}

std::string StandIn::toml(const Model& now) const {
  std::string toml = sky_ + (now.camera ? camera_table(*now.camera) : camera_);
  if (now.lights.empty()) toml += sun_;
  for (const Directional& light : now.lights) toml += light_table(light);
  return toml + rest_;
}

std::string StandIn::remark(const std::vector<Override>& changes) const {
  std::vector<std::string> texts;
  for (const Assumption& assumption : assumed_) {
    const bool is_changed = std::ranges::any_of(changes, [&](const Override& change) {
      return std::ranges::any_of(assumption.paths, [&](const std::string& path) {
        return is_within(change.path, path) || is_within(path, change.path);
      });
    });
    if (!is_changed) texts.push_back(assumption.text);
  }
  if (texts.empty()) return "";
  return fmt::format("assumed: {}; -D changes them", fmt::join(texts, ", "));
}

}  // namespace airlight
