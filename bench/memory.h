#pragma once
#include "row.h"

namespace airlight::bench {

/// Memory that a render takes beyond the scene and its BVH.
std::vector<Row> memory();

}  // namespace airlight::bench
