#pragma once
#include <vector>

#include "row.h"

namespace airlight::bench {

/// Seconds from scenes/sunroom.toml in memory to its picture at 640 x 360, whole_volume on two
/// threads, at three qualities that users ask for: a mean relative squared error (relMSE of
/// image/metrics.h) of .05, .01 and .001. Building the BVH counts.
std::vector<Row> quality();

}  // namespace airlight::bench
