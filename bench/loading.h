#pragma once
#include "row.h"

namespace airlight::bench {

/// From a model's file to the first ray, against the bare parse and the bare build.
std::vector<Row> loading();

}  // namespace airlight::bench
