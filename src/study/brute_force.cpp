#include "study/brute_force.h"

#include <algorithm>
#include <cmath>

namespace airlight {
namespace {

struct Panel {
  double a, fa, m, fm, b, fb;

  double simpson() const { return (b - a) / 6 * (fa + 4 * fm + fb); }
};

double refined(const std::function<double(double)>& f, const Panel& p, double whole,
               double tolerance, int depth) {
  const double lm = 0.5 * (p.a + p.m), rm = 0.5 * (p.m + p.b);
  const Panel left{p.a, p.fa, lm, f(lm), p.m, p.fm}, right{p.m, p.fm, rm, f(rm), p.b, p.fb};
  const double l = left.simpson(), r = right.simpson(), change = l + r - whole;
  if (depth == 0 || std::abs(change) <= 15 * tolerance) return l + r + change / 15;
  return refined(f, left, l, tolerance / 2, depth - 1) +
         refined(f, right, r, tolerance / 2, depth - 1);
}

}  // namespace

double integrate(const std::function<double(double)>& f, double a, double b, double tolerance) {
  if (!(b > a)) return 0;
  constexpr int panels = 8;        // so that no kink hides where the first rules do not look
  constexpr int most_halves = 40;  // neighbouring numbers
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double from = a + (b - a) * i / panels, to = a + (b - a) * (i + 1) / panels;
    const double middle = 0.5 * (from + to);
    const Panel panel{from, f(from), middle, f(middle), to, f(to)};
    sum += refined(f, panel, panel.simpson(), tolerance / panels, most_halves);
  }
  return sum;
}

std::vector<Plane> faces_of(const Box& box) {
  return {{{1, 0, 0}, box.max.x},   {{-1, 0, 0}, -box.min.x}, {{0, 1, 0}, box.max.y},
          {{0, -1, 0}, -box.min.y}, {{0, 0, 1}, box.max.z},   {{0, 0, -1}, -box.min.z}};
}

std::vector<Plane> faces_of(const Convex& convex) {
  return {convex.faces.begin(), convex.faces.begin() + convex.face_count};
}

Interval<double> BruteForceRay::inside(std::span<const Plane> faces, Vec3<double> origin,
                                       Vec3<double> direction) {
  Interval<double> inside{0, far_away};
  for (const Plane& face : faces) {
    const double facing = dot(face.n, direction), above = face.h - dot(face.n, origin);
    if (facing > 0)
      inside.t_exit = std::min(inside.t_exit, above / facing);
    else if (facing < 0)
      inside.t_enter = std::max(inside.t_enter, above / facing);
    else if (above < 0)
      return {0, 0};
  }
  return inside;
}

double BruteForceRay::length_at(double t) const {
  const Vec3<double> p = entry + direction * t;
  double out = far_away;
  for (const Plane& face : faces)
    if (const double facing = dot(face.n, toward); facing > 0)
      out = std::min(out, (face.h - dot(face.n, p)) / facing);
  return t + std::max(out, 0.);
}

double BruteForceRay::transmittance_at(double t) const { return std::exp(-sigma_t * length_at(t)); }

double BruteForceRay::shortest() const { return std::min(length_at(0), length_at(t_max)); }

double BruteForceRay::integral(double from, double to) const {
  const double least = shortest();
  return integrate([&](double t) { return std::exp(-sigma_t * (length_at(t) - least)); }, from, to,
                   1e-12 * t_max);
}

double BruteForceRay::transmittance_integral() const {
  return std::exp(-sigma_t * shortest()) * integral(0, t_max);
}

}  // namespace airlight
