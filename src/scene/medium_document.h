#pragma once
#include <airlight/medium.h>

#include <optional>

#include "scene/cursor.h"
#include "scene/objects/files.h"
#include "scene/required.h"
#include "scene/shape_documents.h"

namespace airlight {

/// A medium as a file says it: its coefficients come in one of three pairs.
struct MediumDocument {
  std::optional<Rgb<double>> sigma_s;
  std::optional<Rgb<double>> sigma_a;
  std::optional<Rgb<double>> sigma_t;
  std::optional<Rgb<double>> albedo;
  std::optional<double> visibility;
  Rgb<double> emission{0, 0, 0};
  Phases phase = Isotropic{};
  Required<ShapeDocuments> shape;

  /// No fog is thicker, and its optical depths stay finite in single precision.
  static constexpr double thickest = 1e6;

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using D = MediumDocument;
    field("sigma_s", &D::sigma_s, unit::per_metre, closed(0, thickest),
          "scattering coefficient; with sigma_a");
    field("sigma_a", &D::sigma_a, unit::per_metre, closed(0, thickest),
          "absorption coefficient; with sigma_s");
    field("sigma_t", &D::sigma_t, unit::per_metre, closed(0, thickest),
          "extinction coefficient; with albedo");
    field("albedo", &D::albedo, unit::one, closed(0, 1),
          "the part of the extinction that is scattering; with sigma_t or visibility");
    field("visibility", &D::visibility, unit::metre, Range{1e-5, far_away, false, false},
          "where contrast falls to 2 %: sigma_t = 3.912 / visibility; with albedo");
    field("emission", &D::emission, unit::radiance_per_metre, at_least(0),
          "radiance gained a metre");
    field("phase", &D::phase, unit::none, any_number(), "how it scatters");
    field("shape", &D::shape, unit::none, any_number(), "where it is");
  }

  /// Throws Error unless exactly one pair of coefficients is given.
  Medium medium(const Cursor& at, const Files& files) const;
};

}  // namespace airlight
