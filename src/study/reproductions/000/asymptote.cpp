#include "study/reproductions/000/asymptote.h"

#include <airlight/placements.h>

#include "geometry/parallel_shadows.h"
#include "render/prepare.h"
#include "study/brute_force.h"

namespace airlight::paper_000 {

Asymptotes asymptotes(const Configuration& configuration) {
  const Scene scene = black_ball(configuration);
  const Box box = std::get<Box>(scene.media[0].shape);
  const std::vector<Plane> faces = faces_of(box);
  const Box::Space space = box.space();
  const Vec3<double> toward = normalize(configuration.toward);
  const ParallelShadows shadows(scene, -toward);
  std::vector<Interval<double>> room(shadows.most_parts());
  const auto [width, height] = scene.resolution;
  const CameraFrame camera = camera_frame(scene.camera, scene.resolution);

  Asymptotes sum;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3<double> d =
          normalize(camera.corner + camera.right * (x + 0.5) + camera.down * (y + 0.5));
      const Interval<double> inside = BruteForceRay::inside(faces, camera.position, d);
      // The ball is about the origin; where the ray meets it, it ends.
      const double b = dot(camera.position, d);
      const double under =
          b * b - dot(camera.position, camera.position) + ball_radius * ball_radius;
      const double end = under > 0 ? -b - std::sqrt(under) : inside.t_exit;
      const double t_max = std::min(end, inside.t_exit) - inside.t_enter;
      if (!(t_max > 0)) continue;
      const Vec3<double> entry = camera.position + d * inside.t_enter;
      using Along = Section<double, 1, Box::Space>;
      Along section(space, {space.point(entry), space.vector(d)}, space.vector(toward), t_max,
                    {configuration.sigma_t});
      section.trace_way_out();
      const Channels<double, 1> one{1};
      const auto whole_volume = WholeVolume{}.on(section, one);
      const auto equidistant = Equidistant{}.on(section, one);
      const auto distance = Distance{}.on(section, one);
      const auto add = [&](double t) {
        constexpr double rounding = 1e-9;  // the ends of the ray are no shadow's
        if (!(t > rounding * t_max && t < (1 - rounding) * t_max)) return;
        const double length = section.way.length_at(t);
        const auto square = [](double weight) { return weight * weight; };
        sum.whole_volume += square(whole_volume.weights(t, length)[0]);
        sum.equidistant += square(equidistant.weights(t, length)[0]);
        sum.distance += square(distance.weights(t, length)[0]);
      };
      for (const Interval<double>& lit : shadows.lit(entry, d, t_max, room))
        add(lit.t_enter), add(lit.t_exit);
    }
  const double scale =
      configuration.strength * configuration.strength / (6. * double(width) * height);
  return {sum.whole_volume * scale, sum.equidistant * scale, sum.distance * scale};
}

}  // namespace airlight::paper_000
