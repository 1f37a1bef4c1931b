#include "scene/accepted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace airlight {
namespace {

/// "in (-1, 1)", "of at least 0", or nothing where every number will do.
std::string limits(const Range& range) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (low && high)
    return fmt::format("in {}{}, {}{}", range.low_open ? '(' : '[', range.low, range.high,
                       range.high_open ? ')' : ']');
  if (low) return fmt::format("{} {}", range.low_open ? "above" : "of at least", range.low);
  if (high) return fmt::format("{} {}", range.high_open ? "below" : "of at most", range.high);
  return "";
}

/// " m", " in m" or nothing: the unit after the limits.
std::string with_unit(const std::string& limit_text, const std::string& unit) {
  if (unit.empty() || unit == unit::one) return limit_text;
  return limit_text.empty() ? "in " + unit : limit_text + " " + unit;
}

}  // namespace

std::string accepted_number(const Range& range, const char* unit, bool whole) {
  const std::string rest = with_unit(limits(range), unit);
  return std::string(whole ? "a whole number" : "a number") + (rest.empty() ? "" : " ") + rest;
}

std::string accepted_numbers(const std::string& form, const Range& range, const char* unit) {
  const std::string limit = limits(range), rest = with_unit(limit, unit);
  return form + (limit.empty() ? (rest.empty() ? "" : " ") : ", each ") + rest;
}

std::string accepted_words(std::vector<std::string> words) {
  std::ranges::sort(words);
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace airlight
