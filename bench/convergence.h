#pragma once
#include "row.h"

namespace airlight::bench {

/// Time to 40 dB on the sphere in fog: whole-volume sampling against ray marching.
std::vector<Row> convergence();

}  // namespace airlight::bench
