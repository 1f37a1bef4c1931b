#pragma once
#include "simd.h"

namespace airlight::inline AIRLIGHT_ISA {

/// A point or a direction. World units are metres.
template <class F>
struct Vec3 {
  F x, y, z;

  constexpr Vec3() noexcept : x(0), y(0), z(0) {}
  constexpr Vec3(F x_, F y_, F z_) noexcept : x(x_), y(y_), z(z_) {}
  /// Narrows constants to the arithmetic at hand.
  template <class G>
  explicit constexpr Vec3(const Vec3<G>& v) noexcept
      : x(static_cast<Narrow>(v.x)), y(static_cast<Narrow>(v.y)), z(static_cast<Narrow>(v.z)) {}

  F operator[](int i) const noexcept { return i == 0 ? x : i == 1 ? y : z; }

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, F s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(F s, Vec3 a) noexcept { return a * s; }
  friend constexpr bool operator==(const Vec3& a,
                                   const Vec3& b) noexcept requires std::floating_point<F> {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }

 private:
  using Narrow = Scalar<F>;
};

/// A point or a direction in a plane.
template <Real F>
struct Vec2 {
  F x, y;
};

template <class F>
constexpr F dot(Vec3<F> a, Vec3<F> b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class F>
constexpr Vec3<F> cross(Vec3<F> a, Vec3<F> b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class F>
F length(Vec3<F> a) noexcept {
  return sqrt(dot(a, a));
}
template <class F>
Vec3<F> normalize(Vec3<F> a) noexcept {
  return a * (F(1) / length(a));
}

/// Two unit vectors that form a right-handed frame with the unit vector n (Duff et al. 2017).
template <Real F>
void orthonormal_basis(Vec3<F> n, Vec3<F>& u, Vec3<F>& v) noexcept {
  const F sign = select(n.z >= F(0), F(1), F(-1));
  const F a = F(-1) / (sign + n.z);
  const F b = n.x * n.y * a;
  u = Vec3<F>(F(1) + sign * n.x * n.x * a, sign * b, -sign * n.x);
  v = Vec3<F>(b, sign + n.y * n.y * a, -n.y);
}

/// Linear red, green and blue.
template <class F>
struct Rgb {
  F r, g, b;

  constexpr Rgb() noexcept : r(0), g(0), b(0) {}
  constexpr explicit Rgb(F grey) noexcept : r(grey), g(grey), b(grey) {}
  constexpr Rgb(F r_, F g_, F b_) noexcept : r(r_), g(g_), b(b_) {}
  template <class G>
  explicit constexpr Rgb(const Rgb<G>& c) noexcept
      : r(static_cast<Narrow>(c.r)), g(static_cast<Narrow>(c.g)), b(static_cast<Narrow>(c.b)) {}

  F& operator[](int i) noexcept { return i == 0 ? r : i == 1 ? g : b; }
  const F& operator[](int i) const noexcept { return i == 0 ? r : i == 1 ? g : b; }

  friend constexpr Rgb operator+(Rgb a, Rgb b) noexcept {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
  }
  friend constexpr Rgb operator-(Rgb a, Rgb b) noexcept {
    return {a.r - b.r, a.g - b.g, a.b - b.b};
  }
  friend constexpr Rgb operator*(Rgb a, Rgb b) noexcept {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
  }
  friend constexpr Rgb operator*(Rgb a, F s) noexcept { return {a.r * s, a.g * s, a.b * s}; }
  friend constexpr Rgb operator*(F s, Rgb a) noexcept { return a * s; }
  Rgb& operator+=(Rgb a) noexcept { return *this = *this + a; }
  Rgb& operator*=(Rgb a) noexcept { return *this = *this * a; }
  friend constexpr bool operator==(const Rgb& a,
                                   const Rgb& b) noexcept requires std::floating_point<F> {
    return a.r == b.r && a.g == b.g && a.b == b.b;
  }

 private:
  using Narrow = Scalar<F>;
};

template <Real F>
Vec3<F> select(Mask<F> condition, Vec3<F> yes, Vec3<F> no) noexcept {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y),
          select(condition, yes.z, no.z)};
}
template <Real F>
Rgb<F> select(Mask<F> condition, Rgb<F> yes, Rgb<F> no) noexcept {
  return {select(condition, yes.r, no.r), select(condition, yes.g, no.g),
          select(condition, yes.b, no.b)};
}

/// exp(-depth) for each channel.
template <Real F>
Rgb<F> exp_minus(Rgb<F> depth) noexcept {
  return {exp(-depth.r), exp(-depth.g), exp(-depth.b)};
}

}  // namespace airlight::inline AIRLIGHT_ISA
