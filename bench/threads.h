#pragma once
#include "row.h"

namespace airlight::bench {

/// What two threads render in the time that two single-threaded renders side by side take for as
/// much.
std::vector<Row> threads();

}  // namespace airlight::bench
