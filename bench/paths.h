#pragma once
#include "row.h"

namespace airlight::bench {

/// Multiple scattering: vertices of paths a second against a bare loop of Embree's packet queries
/// over the same rays, and how many lanes are in use.
std::vector<Row> paths();

}  // namespace airlight::bench
