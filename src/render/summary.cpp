#include "render/summary.h"

#include <airlight/media.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"
#include "geometry/world.h"
#include "render/prepare.h"

namespace airlight {
namespace {

constexpr double hundredth = 4.605170185988091;  // ln 100: the optical depth that passes 1 %

double least(const Rgb<double>& c) { return std::min({c.r, c.g, c.b}); }

template <class F>
Rgb<double> each(const Rgb<double>& c, F&& f) {
  return {f(c.r), f(c.g), f(c.b)};
}

/// "henyey-greenstein, g = 0.3".
template <class T>
std::string with_parameters(const T& thing) {
  std::string text = thing.name;
  if constexpr (requires { T::describe([](auto&&...) {}); })
    T::describe([&](const char* key, auto member, auto&&...) {
      const auto& value = thing.*member;
      using Value = std::remove_cvref_t<decltype(value)>;
      if constexpr (std::is_arithmetic_v<Value>)
        text += fmt::format(", {} = {}", key, value);
      else
        text += fmt::format(", {} = [{}, {}, {}]", key, value.x, value.y, value.z);
    });
  return text;
}

std::string shape_text(const Convex& shape) {
  return fmt::format("convex, {} faces", shape.face_count);
}
std::string shape_text(const Solid& shape) {
  return fmt::format("mesh, {} triangles", shape.mesh->triangles.size());
}
template <class S>
std::string shape_text(const S& shape) {
  return with_parameters(shape);
}

/// A point in the middle of a shape, if it has one.
std::optional<Vec3<double>> middle(const Box& box) { return (box.min + box.max) * 0.5; }
std::optional<Vec3<double>> middle(const Convex& shape) { return shape.centre; }
std::optional<Vec3<double>> middle(const Unbounded&) { return std::nullopt; }
std::optional<Vec3<double>> middle(const Solid& shape) {
  const auto& [x, y, z] = shape.mesh->centre;
  return Vec3<double>(x, y, z);
}

/// What of a ray lies in a medium, the last exit included; how much of it does.
struct Chord {
  Interval<double> inside;
  double length = 0;

  Chord(const Medium& medium, Vec3<double> from, Vec3<double> direction, double t_max = far_away) {
    with_space({&medium, 1}, [&](const Medium* first, const auto& space) {
      const LocalRay<double> ray{space.point(from), space.vector(direction)};
      const auto stretches = stretches_of(first, space, ray);
      inside = stretches.hull();
      for (int j = 0; j < stretches.count; ++j) length += stretches.length_before(j, t_max);
    });
  }
};

/// The longest way through the middle of a shape along the axes.  [m]
std::optional<double> across(const Medium& medium) {
  const auto centre = std::visit([](const auto& shape) { return middle(shape); }, medium.shape);
  if (!centre) return std::nullopt;
  double longest = 0;
  for (const Vec3<double>& axis :
       {Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0), Vec3<double>(0, 0, 1)})
    longest = std::max(longest,
                       Chord(medium, *centre, axis).length + Chord(medium, *centre, -axis).length);
  return longest;
}

MediumSummary summary_of(const Medium& medium, const Camera& camera) {
  MediumSummary result;
  result.shape = std::visit([](const auto& shape) { return shape_text(shape); }, medium.shape);
  result.phase = std::visit([](const auto& phase) { return with_parameters(phase); }, medium.phase);
  const Rgb<double> inverse = each(medium.sigma_t, [](double s) { return s > 0 ? 1 / s : 0; });
  result.albedo = medium.sigma_s * inverse;
  result.mean_free_path = each(medium.sigma_t, [](double s) { return 1 / std::max(s, 0.); });
  result.across = across(medium);
  result.optical_depth = medium.sigma_t * result.across.value_or(0);
  const double distance = length(camera.target - camera.position);
  const Chord view(medium, camera.position, (camera.target - camera.position) * (1 / distance),
                   distance);
  const auto [enter, exit] = view.inside;
  if (exit > enter) {
    result.camera_inside = enter <= 0;
    result.enter = enter;
    if (exit < far_away) result.exit = exit;
    result.to_target = view.length;
  }
  return result;
}

/// Points in the fog that the camera sees: some on each of a coarse grid of camera rays.
std::vector<Vec3<double>> points_in_view(const Scene& scene, const World& world) {
  constexpr int columns = 48, rows = 27, on_a_ray = 6;
  std::vector<Vec3<double>> points;
  const CameraFrame camera = camera_frame(scene.camera, scene.resolution);
  for (int i = 0; i < columns * rows; ++i) {
    const double x = (i % columns + 0.5) / columns * scene.resolution.width;
    const double y = (i / columns + 0.5) / rows * scene.resolution.height;
    const Vec3<double> direction = normalize(camera.corner + camera.right * x + camera.down * y);
    const Hit<double> hit = world.closest<double>(camera.position, direction, 0., true);
    const auto add_points = [&](const Medium& medium, double enter, double leave) {
      // Of an unbounded medium, what lies within a few mean free paths counts.
      const double far = enter + 3 / std::max(least(medium.sigma_t), 1e-9);
      const double end = std::min({hit.found ? hit.t : far_away, leave, far});
      if (!(end > enter)) return;
      for (int k = 0; k < on_a_ray; ++k)
        points.push_back(camera.position +
                         direction * (enter + (k + 0.5) / on_a_ray * (end - enter)));
    };
    with_space(scene.media, [&](const Medium* medium, const auto& space) {
      const LocalRay<double> ray{space.point(camera.position), space.vector(direction)};
      const auto inside = stretches_of(medium, space, ray);
      for (int j = 0; j < inside.count; ++j)
        add_points(inside.medium(j), inside.enter[j], inside.leave[j]);
    });
  }
  return points;
}

template <class L>
LightSummary summary_of(const L& light, int index, const World& world,
                        const std::vector<Vec3<double>>& points) {
  LightSummary result{light.name, light.toward(), light.irradiance, light.angular_diameter, {}};
  if (points.empty()) return result;
  std::size_t in_reach = 0, lit = 0;
  for (const Vec3<double>& p : points) {
    if (!light.contains(p)) continue;
    ++in_reach;
    const Rgb<double> passes =
        world.transmit<double>(p, light.toward(), light.reach(p), index, true);
    lit += passes.r > 0 || passes.g > 0 || passes.b > 0;
  }
  // A beam may pass between the points.
  if (in_reach > 0) result.lit_part = double(lit) / double(points.size());
  return result;
}

void count(const Scene& scene, Summary& result) {
  constexpr std::size_t hierarchy_bytes_a_triangle = 100;  // Embree's default quality, roughly
  result.objects = scene.objects.size();
  result.textures = scene.textures.size();
  for (const Object& object : scene.objects) {
    result.holdouts += object.holdout;
    const auto* mesh = std::get_if<Mesh>(&object.geometry);
    if (!mesh) {
      ++result.spheres;
      continue;
    }
    result.triangles += mesh->triangles.size();
    result.memory.geometry +=
        std::span(mesh->positions).size_bytes() + std::span(mesh->normals).size_bytes() +
        std::span(mesh->uvs).size_bytes() + std::span(mesh->triangles).size_bytes();
  }
  for (const Texture& texture : scene.textures) result.memory.textures += texture.rgba.size();
  result.memory.textures += std::span(scene.background_image.pixels).size_bytes();
  result.memory.hierarchy = hierarchy_bytes_a_triangle * result.triangles;
  result.bounds = bounds_of(scene.objects);
}

void warn_of_medium(const Medium& medium, const MediumSummary& fog,
                    std::vector<std::string>& warnings) {
  const double opaque_after = hundredth / least(medium.sigma_t);
  if (fog.to_target > opaque_after)
    warnings.push_back(
        fmt::format("fog is opaque after {:.2g} m (1 % passes), and there are {:.3g} m of it "
                    "between the camera and its target",
                    opaque_after, fog.to_target));
  else if (fog.across && opaque_after < *fog.across / 2)
    warnings.push_back(
        fmt::format("fog is opaque after {:.2g} m (1 % passes); it is {:.3g} m across",
                    opaque_after, *fog.across));
  if (medium.sigma_s == Rgb<double>() && medium.emission == Rgb<double>())
    warnings.push_back("the medium scatters nothing: no shafts of light can be seen");
  if (!std::holds_alternative<Unbounded>(medium.shape)) return;
  for (std::size_t c = 0; c < 3; ++c)
    if (medium.emission[c] > 0 && !(medium.sigma_t[c] > 0)) {
      warnings.push_back(
          "fog without an end glows and lets all light pass: it is bright without end");
      return;
    }
}

/// Rays start above surfaces by what single precision takes: more than a thousandth of all objects
/// is no small part of a room any more.
void warn_of_distance(const Scene& scene, std::vector<std::string>& warnings) {
  const Bounds bounds = bounds_of(scene.objects);
  if (bounds.empty()) return;
  double distance = 0;
  for (int k = 0; k < 3; ++k)
    distance += std::max(std::abs(bounds.min[k]), std::abs(bounds.max[k]));
  const double lift = World::lift * distance, size = length(bounds.size());
  if (lift > size / 1000)
    warnings.push_back(
        fmt::format("the objects are {:.3g} m across and so far from the origin that rays which "
                    "leave a surface start up to {:.2g} m above it; move the scene to the origin",
                    size, lift));
}

/// How far ahead of the camera, along the middle of the picture, fog begins; nothing if nowhere.
std::optional<double> fog_ahead(const std::vector<MediumSummary>& media) {
  std::optional<double> ahead;
  for (const MediumSummary& fog : media)
    if (fog.enter) ahead = std::min(*fog.enter, ahead.value_or(far_away));
  return ahead;
}

std::vector<MediumSummary> summaries_of(const Scene& scene) {
  std::vector<MediumSummary> media;
  for (const Medium& medium : scene.media) media.push_back(summary_of(medium, scene.camera));
  return media;
}

/// Whether fog could be lit, if nothing were in the way.
bool expects_light(const Scene& scene) {
  return std::ranges::any_of(
             scene.media, [](const Medium& medium) { return medium.sigma_s != Rgb<double>(); }) &&
         std::ranges::any_of(scene.lights, [](const Lights& light) {
           return std::visit([](const auto& l) { return l.irradiance != Rgb<double>(); }, light);
         });
}

std::vector<std::string> remarks_on(const Scene& scene, const Summary& summary) {
  std::vector<std::string> remarks;
  if (const auto ahead = fog_ahead(summary.media); ahead && *ahead > 0)
    remarks.push_back(
        fmt::format("the camera is outside the fog, which begins {:.3g} m ahead", *ahead));
  if (!scene.media.empty() && scene.ambient != Rgb<double>())
    remarks.push_back(
        "ambient lights surfaces only: light of the sky that scatters in the fog is not part of "
        "the model");
  if (!scene.media.empty() && scene.objects.empty())
    remarks.push_back("no objects: nothing throws a shadow");
  return remarks;
}

}  // namespace

std::vector<std::string> warnings_before(const Scene& scene) {
  std::vector<std::string> warnings;
  const std::vector<MediumSummary> media = summaries_of(scene);
  for (std::size_t i = 0; i < media.size(); ++i) warn_of_medium(scene.media[i], media[i], warnings);
  warn_of_distance(scene, warnings);
  if (!media.empty() && !fog_ahead(media))
    warnings.push_back("the camera is outside the fog and does not look into it");
  if (media.empty())
    warnings.push_back(scene.objects.empty()
                           ? "the scene is empty: the picture shows the background only"
                           : "no medium: the picture shows surfaces only");
  else if (scene.lights.empty() && std::ranges::all_of(scene.media, [](const Medium& medium) {
             return medium.emission == Rgb<double>();
           }))
    warnings.push_back("no light: the fog stays dark");
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (std::visit([](const auto& l) { return l.irradiance == Rgb<double>(); }, scene.lights[i]))
      warnings.push_back(fmt::format("lights.{} is black", i));
  return warnings;
}

std::vector<std::string> warnings_after(const Scene& scene, const Film& film) {
  if (film.samples() == 0 || !expects_light(scene)) return {};
  for (int group = 0; group < int(film.groups.size()); ++group)
    for (const PixelSums& pixel : film.pixels(group))
      if (mean_estimate(pixel).radiance() != Rgb<double>()) return {};
  bool beams = false, images = false;
  for (const Lights& light : scene.lights)
    if (const auto* beam = std::get_if<Collimated>(&light))
      beams = true, images = images || beam->image >= 0;
  std::vector<std::string> shades;
  if (images) shades.push_back("images of beams");
  if (!scene.objects.empty()) shades.push_back("objects");
  return {
      fmt::format("no light reaches the fog in the picture: {}{}{}it is out of view or too thick",
                  beams ? "beams miss it, or " : "", fmt::join(shades, " or "),
                  shades.empty() ? "" : " shadow all of it, or ")};
}

Summary summarise(const Scene& scene) {
  Summary result;
  count(scene, result);
  const World world(scene, scene.render.visibility);
  std::vector<Vec3<double>> points;
  result.media = summaries_of(scene);
  if (!scene.media.empty()) points = points_in_view(scene, world);
  result.warnings = warnings_before(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    std::visit(
        [&](const auto& light) {
          result.lights.push_back(summary_of(light, int(i), world, points));
        },
        scene.lights[i]);
  for (std::size_t i = 0; i < result.lights.size(); ++i)
    if (result.lights[i].lit_part == 0.)
      result.warnings.push_back(fmt::format(
          "lights.{} cannot enter: objects{} shadow all of the fog that the camera sees", i,
          std::holds_alternative<Collimated>(scene.lights[i]) ? " or its image" : ""));
  result.remarks = remarks_on(scene, result);
  try {
    check_settings(scene, scene.render);
    result.memory.film = film_layout(scene, estimator_for(scene.render)).bytes_a_pixel() *
                         std::size_t(scene.resolution.width) * std::size_t(scene.resolution.height);
  } catch (const Error& error) {
    result.warnings.push_back(error.what());
  }
  return result;
}

}  // namespace airlight
