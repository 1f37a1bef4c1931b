#pragma once
#include "row.h"

namespace airlight::bench {

/// What keeping the sums of a render in a file costs, and adding up those of two.
std::vector<Row> checkpoints();

}  // namespace airlight::bench
