#pragma once
#include "row.h"

namespace airlight::bench {

/// The closed-form integral of transmittance through a box, one core: time a ray, and how much
/// faster than one lane.
std::vector<Row> closed_form();

}  // namespace airlight::bench
