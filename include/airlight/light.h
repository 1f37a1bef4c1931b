#pragma once
#include "describe.h"
#include "math/vec.h"

namespace airlight::inline AIRLIGHT_ISA {

/// What sends light into a scene.
///
///     L::everywhere         whether it reaches every point, shadows apart: its samples can be
///                           anywhere on a ray, so that a path may go on from them
///     light.contains(p)     whether it reaches p, shadows apart
///     light.reach(p)        how far from p something can stand in its way  [m]
template <class L>
concept Light = requires(const L light, Vec3<double> p) {
  { L::name } -> std::convertible_to<const char*>;
  { L::meaning } -> std::convertible_to<const char*>;
  { L::everywhere } -> std::convertible_to<bool>;
  { light.contains(p) } -> std::same_as<bool>;
  { light.reach(p) } -> std::same_as<double>;
};

/// A light that comes to all points of a camera ray from one direction and is as strong at all of
/// them, but for the medium: the closed form of Velinov 2021, the `Section` with its way out, is
/// of such light.
///
///     light.irradiance         on a plane across it, outside the medium  [W/m2]
///     light.toward()           unit vector towards it, or towards the middle of its disc
///     light.angular_diameter   of the disc around that; every camera ray has one direction of it
///                              [degrees]
///     light.cap_height()       1 − cos of the disc's angular radius
template <class L>
concept ParallelLight = Light<L> && requires(const L light) {
  { light.irradiance } -> std::convertible_to<Rgb<double>>;
  { light.toward() } -> std::same_as<Vec3<double>>;
  { light.angular_diameter } -> std::convertible_to<double>;
  { light.cap_height() } -> std::same_as<double>;
};

}  // namespace airlight::inline AIRLIGHT_ISA
