#pragma once
#include <airlight/shapes.h>

#include <functional>
#include <span>
#include <vector>

namespace airlight {

/// The integral of f over [a, b] by adaptive Simpson rules: halved until the estimated error of
/// every part is below its share of `tolerance`. Kinks of f cost time but no accuracy.
double integrate(const std::function<double(double)>& f, double a, double b, double tolerance);

/// The half-spaces that a shape lies in.
std::vector<Plane> faces_of(const Box& box);  ///< of a box that is not turned
std::vector<Plane> faces_of(const Convex& convex);

/// A camera ray through a convex medium and one direction towards the light, taken face by face at
/// every point. It knows no trapezoids and shares no formula with the renderer, so that it can
/// judge it.
struct BruteForceRay {
  std::span<const Plane> faces;
  Vec3<double> entry, direction, toward;
  double t_max = 0;    ///< the length inside  [m]
  double sigma_t = 1;  ///< [1/m]

  /// The part of a ray that lies within all faces, from its origin on; empty where t_exit <=
  /// t_enter.
  static Interval<double> inside(std::span<const Plane> faces, Vec3<double> origin,
                                 Vec3<double> direction);

  double length_at(double t) const;         ///< from the entry to p(t) and on along w  [m]
  double transmittance_at(double t) const;  ///< e^{−σ length}

  /// ∫ e^{−σ length} dt over [from, to] in units of e^{−σ shortest}, which it is the same to leave
  /// out of every quotient; off by less than 1e-12 of the ray's length.  [m]
  double integral(double from, double to) const;

  /// The whole integral T.  [m]
  double transmittance_integral() const;

 private:
  double shortest() const;
};

}  // namespace airlight
