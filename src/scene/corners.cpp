#include "scene/corners.h"

#include <fmt/format.h>

namespace airlight {

void check_corners(const Vec3<double>& min, const Vec3<double>& max, const Cursor& at) {
  for (int k = 0; k < 3; ++k) {
    if (max[k] > min[k]) continue;
    at.at_or_here("max").complain(
        fmt::format("{} min in {} ({} and {}): the box {}; max must lie above min in x, y and z",
                    max[k] < min[k] ? "lies below" : "equals", "xyz"[k], max[k], min[k],
                    max[k] < min[k] ? "is inverted" : "is empty"));
  }
}

}  // namespace airlight
