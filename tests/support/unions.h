#pragma once
#include <airlight/medium.h>

#include <vector>

#include "exact_way.h"
#include "quadrature.h"
#include "rays_in_a_box.h"

namespace airlight::test {

/// Convex bodies apart from each other, each with its own coefficients, and a ray among them: what
/// the core says in pieces, written down once more point by point.
struct Union {
  struct Part {
    Body body;
    Medium medium;
  };
  std::vector<Part> parts;
  BoxRay ray;
  LightStart<double> start = {};  ///< where light starts

  /// The way of o + t d, t in [0, t_max], through a body.
  static Exact chord(const Body& body, const Point& o, const Point& d, Exact t_max) {
    Exact enter = 0, leave = t_max;
    for (const HalfSpace& face : body) {
      const Exact facing = dot(face.n, d), above = face.h - dot(face.n, o);
      if (facing > 0)
        leave = std::min(leave, above / facing);
      else if (facing < 0)
        enter = std::max(enter, above / facing);
      else if (above < 0)
        return 0;
    }
    return std::max<Exact>(leave - enter, 0);
  }

  /// Optical depth of channel c of the whole way through p(t).
  Exact depth(Exact t, int c) const {
    const Point o = point(ray.o), d = point(ray.d), w = point(ray.w);
    Exact sum = 0;
    for (const Part& part : parts)
      sum += Exact(part.medium.sigma_t[c]) *
             (chord(part.body, o, d, t) + chord(part.body, along(o, d, t), w, start(double(t))));
    return sum;
  }

  /// What scatters at p(t), with the phase function at cosine w·d.
  double strength(Exact t, int c) const {
    for (const Part& part : parts)
      if (is_inside(part.body, along(point(ray.o), point(ray.d), t)))
        return part.medium.sigma_s[c] * evaluate(part.medium.phase, airlight::dot(ray.w, ray.d));
    return 0;
  }

  /// Every t where depth or strength can have a kink or a jump, and more.
  std::vector<double> breaks() const {
    std::vector<double> result;
    const Point o = point(ray.o), d = point(ray.d), w = point(ray.w);
    for (const Part& part : parts) {
      std::vector<std::array<Exact, 2>> lines = {{0, 0}, {start.a, start.b}};
      for (const HalfSpace& face : part.body) {
        const Exact facing = dot(face.n, w), above = face.h - dot(face.n, o);
        if (dot(face.n, d) != 0) result.push_back(double(above / dot(face.n, d)));
        if (facing != 0) lines.push_back({above / facing, -dot(face.n, d) / facing});
      }
      for (std::size_t i = 0; i < lines.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (lines[i][1] != lines[j][1])
            result.push_back(double((lines[i][0] - lines[j][0]) / (lines[j][1] - lines[i][1])));
    }
    return result;
  }

  /// The smallest depth of channel c where anything scatters, about.
  Exact least_depth(int c) const {
    std::vector<double> t = breaks();
    std::erase_if(t, [&](double x) { return !(x > 0 && x < ray.t_max); });
    t.push_back(0), t.push_back(ray.t_max);
    std::ranges::sort(t);
    Exact least = 1e30L;
    for (std::size_t i = 1; i < t.size(); ++i)
      for (const double part : {1e-6, 0.5, 1 - 1e-6}) {
        const double at = t[i - 1] + part * (t[i] - t[i - 1]);
        if (t[i] - t[i - 1] > 1e-9 && strength(at, c) > 0) least = std::min(least, depth(at, c));
      }
    return least < 1e29L ? least : 0;
  }

  /// ∫ s e^{base − τ} dt from one point to another by quadrature.
  double integral(int c, Exact base, double from, double to) const {
    return integrate(
        from, to, [&](double t) { return strength(t, c) * double(std::exp(base - depth(t, c))); },
        1e-13, breaks());
  }

  friend std::ostream& operator<<(std::ostream& out, const Union& all) {
    for (const Union::Part& part : all.parts) {
      const Box& b = std::get<Box>(part.medium.shape);
      out << "[" << b.min.x << ", " << b.max.x << "]x[" << b.min.y << ", " << b.max.y << "]x["
          << b.min.z << ", " << b.max.z << "] sigma_t " << part.medium.sigma_t.r << "; ";
    }
    return out << all.ray;
  }
};

}  // namespace airlight::test
