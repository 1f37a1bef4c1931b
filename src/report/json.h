#pragma once
#include <span>
#include <string>

#include "report/check.h"

namespace airlight {

/// The rows as `result.json` holds them: an array of {label, published, measured, low, high}.
/// Numbers have the digits to be read back exactly; null stands for "not published", NaN and
/// infinity.
std::string json(std::span<const Row> rows);

}  // namespace airlight
