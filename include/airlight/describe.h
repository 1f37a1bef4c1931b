#pragma once
/// How a parameter is described, once: its key, its member, its unit, the values accepted and its
/// meaning. The scene reader, its errors, `airlight list`, overrides by path and the reference page
/// follow from it.
///
///     template <class Visitor>
///     static constexpr void describe(Visitor&& field) {
///       field("g", &HenyeyGreenstein::g, unit::one, open(-1, 1), "mean cosine; ...");
///     }
///
/// A member may be a number, an Rgb (one number stands for three equal ones), a Vec3, a bool, a
/// string, an enum with `words`, a described struct, an optional or a vector of those, or a family
/// (a std::variant of described structs, told apart in a file by the key "type"). Its default is
/// the value of a default-constructed struct.
#include <limits>

#include "math/simd.h"

namespace airlight::inline AIRLIGHT_ISA {

namespace unit {
inline constexpr const char* none = "";
inline constexpr const char* one = "1";
inline constexpr const char* metre = "m";
inline constexpr const char* per_metre = "1/m";
inline constexpr const char* degree = "degrees";
inline constexpr const char* pixel = "pixels";
inline constexpr const char* second = "s";
inline constexpr const char* metre_per_second = "m/s";
inline constexpr const char* stop = "stops";
inline constexpr const char* irradiance = "W/m2";
inline constexpr const char* radiance = "W/(m2 sr)";
inline constexpr const char* radiance_per_metre = "W/(m3 sr)";
}  // namespace unit

/// The numbers accepted; infinities as ends mean "any", but a value must always be finite.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  constexpr bool contains(double x) const noexcept {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
  }
};

constexpr Range open(double low, double high) noexcept { return {low, high, true, true}; }
constexpr Range closed(double low, double high) noexcept { return {low, high, false, false}; }
constexpr Range at_least(double low) noexcept { return {.low = low}; }
constexpr Range above(double low) noexcept { return {.low = low, .low_open = true}; }
constexpr Range any_number() noexcept { return {}; }

/// A word of a file and the value of an enum it stands for.
template <class E>
struct Word {
  const char* text;
  E value;
  const char* meaning;
};

/// The words of an enum: specialise as `template <> inline constexpr Word<Filter> words<Filter>[] =
/// {...};`
template <class E>
inline constexpr Word<E> words[] = {};

}  // namespace airlight::inline AIRLIGHT_ISA
