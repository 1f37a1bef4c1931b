#pragma once
#include <variant>

#include "placements/distance.h"
#include "placements/equidistant.h"
#include "placements/mixed.h"
#include "placements/whole_volume.h"

namespace airlight::inline AIRLIGHT_ISA {

/// Every placement there is. To add one: its file in placements/ and its name here.
using Placements = std::variant<Equidistant, Distance, WholeVolume, Mixed>;

static_assert(Placement<Equidistant> && Placement<Distance> && Placement<WholeVolume> &&
              Placement<Mixed>);

}  // namespace airlight::inline AIRLIGHT_ISA
