#pragma once
#include <airlight/box_tree.h>
#include <airlight/way_out.h>

#include <span>
#include <vector>

namespace airlight {

struct Scene;
struct Sphere;

/// The shadows that opaque objects cast in light that travels the same way everywhere, exactly: a
/// triangle shades the prism behind it, a sphere itself and half a cylinder. A ray meets each of
/// them in one interval; light that starts inside a sphere lights a hollow of it, which leaves two.
/// Triangles are found by a tree: a ray takes as long as there are shadows near it.
class ParallelShadows {
 public:
  /// `travel` is the unit direction in which the light goes. It may start at a plane travel · p =
  /// `start`, before which nothing throws shadows. Throws Error if an object lets light through.
  ParallelShadows(const Scene& scene, Vec3<double> travel, double start = -far_away);

  /// The parts of the ray in [0, t_max] that light reaches, in order, apart from each other; of a
  /// light that starts at a plane, the ray must lie beyond that. They are put together in `room`,
  /// which has place for `most_parts()`.
  std::span<const Interval<double>> lit(Vec3<double> origin, Vec3<double> direction, double t_max,
                                        std::span<Interval<double>> room) const noexcept;

  /// How many parts a ray may have: one before every shadow and one behind the last.
  std::size_t most_parts() const noexcept { return prisms_.size() + 2 * balls_.size() + 1; }

 private:
  /// normal · p >= offset.
  struct HalfSpace {
    Vec3<double> normal;
    double offset;
  };
  using Triangle = std::array<Vec3<double>, 3>;
  struct Prism {
    HalfSpace faces[4];  ///< of the triangle itself and of the three sides
  };
  struct Ball {
    Vec3<double> centre;
    double radius;
  };
  /// What a sphere shades, as if it were a ball, but for what lies both in `inside` and in the
  /// cylinder of radius `opening` along the light.
  struct BallShadow {
    Ball ball;
    Ball inside = ball;
    double opening = 0;
  };

  void add(const Sphere& sphere);
  void add_beyond_start(const Triangle& corners, std::vector<Triangle>& triangles) const;
  void throw_prisms(std::span<const Triangle> triangles);
  Prism prism_behind(const Triangle& corners) const;
  static Interval<double> shaded(const Prism& prism, Vec3<double> origin, Vec3<double> direction);
  Interval<double> cylinder(Vec3<double> centre, double radius, Vec3<double> origin,
                            Vec3<double> direction) const;
  Interval<double> shaded(const Ball& ball, Vec3<double> origin, Vec3<double> direction) const;
  Interval<double> hollow(const BallShadow& shadow, Vec3<double> origin,
                          Vec3<double> direction) const;

  Vec3<double> travel_;
  double start_;
  std::vector<Prism> prisms_;
  BoxTree tree_;  ///< over the prisms' triangles
  std::vector<BallShadow> balls_;
};

}  // namespace airlight
