#include "scene/room_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "scene/direction.h"

namespace airlight {
namespace {

using Vec = Vec3<double>;

constexpr double fov = 55;       ///< vertical; in 16:9 it shows 86 degrees from left to right
constexpr double in_view = 0.8;  ///< cosine to the middle of the picture: about what it shows

bool is_sky(const Panorama& panorama, std::size_t direction) {
  return panorama.distance[direction] >= float(far_away);
}

/// Whether one stands among surfaces, neither in the open nor in something solid.
bool is_inside(const Panorama& panorama) {
  std::size_t sky = 0;
  for (std::size_t i = 0; i < Panorama::directions; ++i) sky += is_sky(panorama, i);
  return sky < Panorama::directions / 4 && panorama.inside_out() < 0.1;
}

/// What encloses some points inside a room: between the 5th and the 95th percentile of what is seen
/// from them, so that a view out of a window does not count.
Bounds room_around(std::span<const Panorama> panoramas, const Bounds& all) {
  std::vector<double> x, y, z;
  for (const Panorama& panorama : panoramas)
    for (std::size_t i = 0; i < Panorama::directions; ++i) {
      if (is_sky(panorama, i)) continue;
      const Vec p = panorama.from + Panorama::direction(i) * double(panorama.distance[i]);
      x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    }
  const auto range = [](std::vector<double>& values, double& low, double& high) {
    std::ranges::sort(values);
    low = values[values.size() / 20];
    high = values[values.size() - 1 - values.size() / 20];
  };
  Bounds room;
  range(x, room.min.x, room.max.x);
  range(y, room.min.y, room.max.y);
  range(z, room.min.z, room.max.z);
  const Vec margin = room.size() * 0.05;
  room = {room.min - margin, room.max + margin};
  for (Vec* corner : {&room.min, &room.max})
    *corner = {std::clamp(corner->x, all.min.x, all.max.x),
               std::clamp(corner->y, all.min.y, all.max.y),
               std::clamp(corner->z, all.min.z, all.max.z)};
  // Floor and ceiling lie at steep angles, where few directions look.
  const double near = 0.3 * room.size().y;
  if (room.min.y - all.min.y < near) room.min.y = all.min.y;
  if (all.max.y - room.max.y < near) room.max.y = all.max.y;
  return room;
}

/// Panoramas of those of `count` points, spread evenly over a box, that are inside the room.
std::vector<Panorama> places_in(const Bounds& box, int count, const std::vector<Object>& objects) {
  const Vec size = box.size();
  std::vector<Vec> points;
  for (int i = 1; i <= count; ++i) {
    // Multiples of the powers of the plastic number's cousin in three dimensions (Roberts 2018).
    const auto part = [&](double step) { return std::fmod(0.5 + step * i, 1.0); };
    points.push_back(box.min + Vec{size.x * part(0.8191725133961645),
                                   size.y * part(0.6710436067037893),
                                   size.z * part(0.5497004779019703)});
  }
  std::vector<Panorama> places = look_around(objects, points);
  std::erase_if(places, [](const Panorama& place) { return !is_inside(place); });
  return places;
}

std::size_t nearest_direction(Vec d) {
  std::size_t nearest = 0;
  double most = -2;
  for (std::size_t i = 0; i < Panorama::directions; ++i)
    if (const double cosine = dot(d, Panorama::direction(i)); cosine > most)
      most = cosine, nearest = i;
  return nearest;
}

/// The directions that the sun may come from: low enough to come in obliquely.
std::vector<std::size_t> suns() {
  const double lowest = std::sin(18 * pi / 180), highest = std::sin(40 * pi / 180);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < Panorama::directions; ++i)
    if (const double height = Panorama::direction(i).y; height > lowest && height < highest)
      found.push_back(i);
  return found;
}

std::size_t nearest_place(Vec point, std::span<const Panorama> places) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec to = places[i].from - point;
    if (const double square = dot(to, to); square < least) least = square, nearest = i;
  }
  return nearest;
}

/// Where the middle of a picture may be: level or nearly, so that walls stay upright.
std::vector<Vec> aims() {
  std::vector<Vec> all;
  for (int azimuth = 0; azimuth < 360; azimuth += 20)
    for (const double elevation : {-6., 6.}) all.push_back(toward_sky(azimuth, elevation));
  return all;
}

using Brightness = std::array<double, Panorama::directions>;

/// How far it is from a point in a box to its boundary.
double way_out_of(const Bounds& box, Vec from, Vec direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double end = direction[k] > 0 ? box.max[k] : box.min[k];
    if (direction[k] != 0) nearest = std::min(nearest, (end - from[k]) / direction[k]);
  }
  return std::max(nearest, 0.0);
}

/// The air of a room before a camera: points along each of its panorama's directions, evenly spread
/// up to the first surface.
class Air {
 public:
  static constexpr int steps = 8;

  Air(const Panorama& camera, const Bounds& room) : camera_(camera), room_(room) {}

  Vec point(std::size_t direction, int step) const {
    return camera_.from + Panorama::direction(direction) * (stride(direction) * (step + 0.5));
  }

  /// How bright the air looks in a direction towards which some of the points are lit. Fog scatters
  /// forward, but who looks along a shaft does not see its shape.
  double brightness(std::size_t direction, int lit, Vec sun) const {
    const double forward = dot(Panorama::direction(direction), sun);
    return stride(direction) * lit * (1 + 0.8 * forward) *
           std::pow(std::max(1 - forward * forward, 0.0), 0.25);
  }

 private:
  /// Of a step.  [m]
  double stride(std::size_t direction) const {
    const double out = way_out_of(room_, camera_.from, Panorama::direction(direction));
    return std::min(double(camera_.distance[direction]), out) / steps;
  }

  const Panorama& camera_;
  const Bounds& room_;
};

/// The directions that a picture shows.
std::vector<std::size_t> picture(Vec toward) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < Panorama::directions; ++i)
    if (dot(Panorama::direction(i), toward) > in_view) shown.push_back(i);
  return shown;
}

/// The standard deviation of the air's light in a picture: shafts are seen where some of it is
/// bright and some dark.
double contrast(std::span<const std::size_t> picture, const Brightness& brightness) {
  double sum = 0, squares = 0;
  for (const std::size_t i : picture) {
    sum += brightness[i];
    squares += brightness[i] * brightness[i];
  }
  const double n = std::max(double(picture.size()), 1.0);
  return std::sqrt(std::max(squares / n - sum * sum / (n * n), 0.0));
}

/// How much of a room a picture shows: how far one sees, with a window that does not fill it.
double outlook(const Panorama& camera, Vec toward, double far) {
  double count = 0, sky = 0;
  for (const std::size_t i : picture(toward)) ++count, sky += is_sky(camera, i);
  const double off = (sky / std::max(count, 1.0) - 0.03) / 0.25;
  return camera.free_way(toward * far) * std::max(1 - off * off, 0.0);
}

/// A way to look at the room under a sun.
struct Look {
  const Panorama* camera = nullptr;
  Vec toward, sun;
  double outlook = 0;
  double score = 0;  ///< how good it is
};

/// What there is to choose from.
struct Choice {
  std::vector<Panorama> cameras;
  std::vector<Vec> aims;
  std::vector<std::size_t> suns;  ///< as directions of a panorama
};

/// For each camera the best of its looks: the air is taken to be lit where the nearest place is.
std::vector<Look> estimate(const Choice& choice, std::span<const Panorama> places,
                           const Bounds& room) {
  const double far = length(room.size());
  std::vector<std::vector<std::size_t>> pictures;
  for (const Vec& aim : choice.aims) pictures.push_back(picture(aim));
  std::vector<Look> looks(choice.cameras.size());
  tbb::parallel_for(std::size_t(0), looks.size(), [&](std::size_t c) {
    const Panorama& camera = choice.cameras[c];
    const Air air(camera, room);
    std::array<std::array<std::size_t, Air::steps>, Panorama::directions> nearest;
    for (std::size_t i = 0; i < Panorama::directions; ++i)
      for (int k = 0; k < Air::steps; ++k) nearest[i][k] = nearest_place(air.point(i, k), places);
    std::vector<double> outlooks;
    for (const Vec& aim : choice.aims) outlooks.push_back(outlook(camera, aim, far));
    for (const std::size_t sun : choice.suns) {
      const Vec toward_sun = Panorama::direction(sun);
      Brightness brightness;
      for (std::size_t i = 0; i < Panorama::directions; ++i) {
        int lit = 0;
        for (const std::size_t place : nearest[i]) lit += is_sky(places[place], sun);
        brightness[i] = air.brightness(i, lit, toward_sun);
      }
      for (std::size_t a = 0; a < choice.aims.size(); ++a) {
        const double score = contrast(pictures[a], brightness) * outlooks[a];
        if (score > looks[c].score)
          looks[c] = {&camera, choice.aims[a], toward_sun, outlooks[a], score};
      }
    }
  });
  return looks;
}

/// The best of some looks, with sights to the sun from the air itself.
Look best_of(std::vector<Look> looks, const std::vector<Object>& objects, const Bounds& room) {
  std::vector<Sight> sights;
  for (const Look& look : looks)
    for (const std::size_t i : picture(look.toward))
      for (int k = 0; k < Air::steps; ++k)
        sights.push_back({Air(*look.camera, room).point(i, k), look.sun});
  const std::vector<std::uint8_t> lit = see_the_sky(objects, sights);
  std::size_t sight = 0;
  Look best;
  for (Look& look : looks) {
    const std::vector<std::size_t> shown = picture(look.toward);
    Brightness brightness;
    for (const std::size_t i : shown) {
      int count = 0;
      for (int k = 0; k < Air::steps; ++k) count += lit[sight++];
      brightness[i] = Air(*look.camera, room).brightness(i, count, look.sun);
    }
    look.score = contrast(shown, brightness) * look.outlook;
    if (look.score > best.score) best = look;
  }
  return best;
}

}  // namespace

RoomView room_view(const std::vector<Object>& objects, const Panorama& middle, const Bounds& all,
                   const std::optional<Camera>& given_camera,
                   const std::optional<Vec3<double>>& given_sun) {
  Bounds room = room_around({&middle, 1}, all);
  std::vector<Panorama> places = places_in(room, 32, objects);
  if (!places.empty()) {
    room = room_around(places, all);
    for (Panorama& place : places_in(room, 96, objects)) places.push_back(place);
  } else {
    places = {middle};  // such as between walls that show their backs
  }
  const double far = length(room.size());
  Choice choice{{}, aims(), suns()};
  if (given_sun) choice.suns = {nearest_direction(*given_sun)};
  if (given_camera) {
    choice.cameras = look_around(objects, {given_camera->position});
    choice.aims = {normalize(given_camera->target - given_camera->position)};
  } else {
    for (const Panorama& place : places) {
      const double height = (place.from.y - room.min.y) / room.size().y;
      if (height > 0.25 && height < 0.65) choice.cameras.push_back(place);
    }
  }

  std::vector<Look> looks = estimate(choice, places, room);
  std::ranges::sort(looks, std::greater(), &Look::score);
  constexpr std::size_t finalists = 8;
  looks.resize(std::min(looks.size(), finalists));
  std::erase_if(looks, [](const Look& look) { return look.score == 0; });
  Look best = best_of(std::move(looks), objects, room);
  if (best.score == 0) {  // no sun comes in: from the middle, towards the most open side
    best = {&middle, choice.aims[0], toward_sky(60, 35)};
    for (const Vec& aim : choice.aims)
      if (middle.free_way(aim * far) > middle.free_way(best.toward * far)) best.toward = aim;
  }
  if (given_sun) best.sun = *given_sun;
  const Vec from = best.camera->from;
  return {{from, from + best.toward * (0.5 * far), {0, 1, 0}, fov},
          std::atan2(best.sun.x, -best.sun.z) * 180 / pi,
          std::asin(best.sun.y) * 180 / pi,
          room};
}

}  // namespace airlight
