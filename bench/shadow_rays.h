#pragma once
#include "row.h"

namespace airlight::bench {

/// Shadow rays a second of a whole render against a bare loop of Embree's packet query over the
/// same rays.
std::vector<Row> shadow_rays();

}  // namespace airlight::bench
