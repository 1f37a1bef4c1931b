#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace airlight {

/// A film is made of blocks of 4 x 4 pixels. Within a block, pixels follow the bits of their
/// coordinates in turn (Morton's order), so that the 2 x 2, 4 x 2 or 4 x 4 pixels of a packet of 4,
/// 8 or 16 lanes lie side by side: a packet adds its sums by whole registers.
namespace film_block {
inline constexpr int side = 4;
inline constexpr int pixels = side * side;

/// Where a pixel of a block, or a lane of a packet, lies.
constexpr int x(int index) noexcept { return (index & 1) | ((index >> 1) & 2); }
constexpr int y(int index) noexcept { return ((index >> 1) & 1) | ((index >> 2) & 2); }

/// The same of all, in order.
template <class T>
struct Places {
  alignas(64) std::array<T, pixels> x, y;
};
template <class T>
inline constexpr Places<T> places = [] {
  Places<T> result{};
  for (int i = 0; i < pixels; ++i)
    result.x[std::size_t(i)] = T(x(i)), result.y[std::size_t(i)] = T(y(i));
  return result;
}();

/// The inverse: the index of a pixel in its block.
constexpr int index(int x, int y) noexcept {
  return (x & 1) | ((y & 1) << 1) | ((x & 2) << 1) | ((y & 2) << 2);
}
}  // namespace film_block

/// Which numbers a film keeps of a pixel, and where: each is a row of 16 in every block. Sums of
/// radiance are kept in double; in float what describes the picture, what tells its error, and what
/// stands in quotients. Floats are added in runs of the samples that a tile gets at a time.
///
///     double, for each light group:  plain, analytic, occluded, unoccluded (as used), surface; RGB
///             then, of holdouts:     plate
///     float:                         transmittance, albedo, normal, depth, object
///             for each light group:  the in-scatter's sums again, of its second half of samples
///             then, of holdouts:     seen, and for each light group lit, was_lit
struct FilmLayout {
  int groups = 1;       ///< of lights; the first is of all that belongs to none
  bool plain = true;    ///< an estimator without a quotient, or emission
  bool ratio = true;    ///< an estimator with a quotient
  bool shadow = false;  ///< holdouts that the medium or other objects may shadow

  /// Numbers of a group's in-scatter.
  constexpr int estimate() const noexcept { return (plain ? 3 : 0) + (ratio ? 9 : 0); }

  /// Rows of doubles in a block.
  constexpr int sums() const noexcept { return plate() + (shadow ? 3 : 0); }
  constexpr int in_scatter(int group) const noexcept { return group * (estimate() + 3); }
  constexpr int surface(int group) const noexcept { return in_scatter(group) + estimate(); }
  constexpr int plate() const noexcept { return in_scatter(groups); }

  /// Rows of floats in a block.
  constexpr int features() const noexcept { return shadow ? holdout_light(groups) : holdouts(); }
  static constexpr int transmittance = 0, albedo = 3, normal = 6;
  static constexpr int added = 9;  ///< the first ones add up; depth and object do not
  static constexpr int depth = 9, object = 10;
  constexpr int second_half(int group) const noexcept { return 11 + group * estimate(); }
  constexpr int holdouts() const noexcept { return second_half(groups); }
  constexpr int holdout_light(int group) const noexcept { return holdouts() + 3 + 6 * group; }

  constexpr std::size_t bytes_a_pixel() const noexcept {
    return std::size_t(sums()) * sizeof(double) + std::size_t(features()) * sizeof(float) +
           2 * sizeof(std::uint32_t);
  }

  friend constexpr bool operator==(const FilmLayout&, const FilmLayout&) noexcept = default;
};

/// Where the numbers of some pixels that lie side by side in a block begin; rows are 16 numbers
/// apart.
struct FilmPixels {
  double* sums;
  float* features;
  std::uint32_t* samples;  ///< two rows: how many are in each half
};

}  // namespace airlight
