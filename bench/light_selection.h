#pragma once
#include "row.h"

namespace airlight::bench {

/// The noise of samples that ask one of five suns each: picked by the closed form against blindly.
std::vector<Row> light_selection();

}  // namespace airlight::bench
