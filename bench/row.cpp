#include "row.h"

#include <fmt/format.h>

#include <cmath>

namespace airlight::bench {

bool Must::holds(double value) const {
  switch (be) {
    case Be::at_least:
      return value >= bound;
    case Be::at_most:
      return value <= bound;
    case Be::anything:
      break;
  }
  return !std::isnan(value);
}

std::string Must::text() const {
  switch (be) {
    case Be::at_least:
      return fmt::format(">= {:g}", bound);
    case Be::at_most:
      return fmt::format("<= {:g}", bound);
    case Be::anything:
      break;
  }
  return "";
}

}  // namespace airlight::bench
