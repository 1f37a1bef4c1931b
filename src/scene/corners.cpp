#include "scene/corners.h"

#include <fmt/format.h>

namespace airlight {

void check_corners(const Vec3<double>& min, const Vec3<double>& max, const Cursor& at) {
  for (int k = 0; k < 3; ++k) {
    if (max[k] > min[k]) continue;
    at.complain(fmt::format("is an {} box: max {} min in {} ({} and {}); max must lie above min in "
                            "x, y and z",
                            max[k] < min[k] ? "inverted" : "empty",
                            max[k] < min[k] ? "lies below" : "equals", "xyz"[k], max[k], min[k]),
                {"max", "min"});
  }
}

}  // namespace airlight
