#pragma once
#include <string>
#include <vector>

#include "row.h"

namespace airlight::bench {

/// row | measured | must reach | holds | instruction set, in columns under a heading.
std::string table(const std::vector<Row>& rows);

/// `[{name, value, unit, must, holds}]`; `must` is text such as ">= 7", or null for a row that only
/// informs; a value that is no number is null.
std::string to_json(const std::vector<Row>& rows);

}  // namespace airlight::bench
