#pragma once
#include "scene/objects/keys.h"

namespace airlight {

/// A tree of a few branches whose leaves are cut out of small cards by a generated texture. It
/// stands at the origin.
struct TreeObject : PlacedObject {
  double height = 8;
  double trunk_radius = 0.16;
  double crown_radius = 2.2;
  double crown_start = 0.35;
  std::int64_t leaves = 4000;
  double leaf_size = 0.35;
  Rgb<double> leaf_albedo{0.16, 0.32, 0.06};
  Rgb<double> bark_albedo{0.16, 0.11, 0.07};
  std::int64_t seed = 0;

  static constexpr auto name = "tree";
  static constexpr auto meaning = "a generated tree with cut-out leaves, standing at the origin";

  template <class Visitor>
  static constexpr void describe(Visitor&& field) {
    using O = TreeObject;
    field("height", &O::height, unit::metre, above(0), "from the ground to the top");
    field("trunk_radius", &O::trunk_radius, unit::metre, above(0), "at the ground");
    field("crown_radius", &O::crown_radius, unit::metre, above(0), "how far branches reach");
    field("crown_start", &O::crown_start, unit::one, Range{0, 1, false, true},
          "where the crown starts, as part of the height");
    field("leaves", &O::leaves, unit::none, closed(0, 1000000), "cards with a twig of leaves each");
    field("leaf_size", &O::leaf_size, unit::metre, above(0), "edge of a card");
    field("leaf_albedo", &O::leaf_albedo, unit::one, closed(0, 1), "of the leaves");
    field("bark_albedo", &O::bark_albedo, unit::one, closed(0, 1), "of trunk and branches");
    field("seed", &O::seed, unit::none, closed(0, 4294967295.), "another seed grows another tree");
    PlacedObject::describe(field);
  }

  Parts build(const Cursor&) const;
};

}  // namespace airlight
