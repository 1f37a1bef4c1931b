#pragma once
#include <airlight/math/vec.h>

#include <cmath>
#include <random>

namespace airlight::test {

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}

  double uniform() { return std::ldexp(double(generator_() >> 11), -53); }
  double uniform(double a, double b) { return a + (b - a) * uniform(); }
  double log_uniform(double a, double b) { return a * std::pow(b / a, uniform()); }
  int below(int n) { return int(uniform() * n); }
  double sign() { return uniform() < 0.5 ? -1 : 1; }
  template <class T, std::size_t n>
  T of(const T (&choices)[n]) {
    return choices[below(int(n))];
  }
  Vec3<double> in_the_cube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
  /// Uniform over the sphere.
  Vec3<double> direction() {
    for (;;) {
      const Vec3<double> v = in_the_cube();
      const double square = airlight::dot(v, v);
      if (square > 1e-2 && square <= 1) return normalize(v);
    }
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace airlight::test
