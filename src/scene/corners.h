#pragma once
#include <airlight/math/vec.h>

#include "scene/cursor.h"

namespace airlight {

/// Throws Error at the keys `min` and `max` unless max lies above min in every component.
void check_corners(const Vec3<double>& min, const Vec3<double>& max, const Cursor& at);

}  // namespace airlight
