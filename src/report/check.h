#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace airlight {

/// One number of a paper, what we measure for it, and the range in which it counts as reproduced.
struct Row {
  std::string label;
  std::optional<double> published;  ///< none where the paper prints no number
  double measured = 0;
  double low = 0;   ///< smallest value that holds; −infinity where any is small enough
  double high = 0;  ///< largest value that holds; infinity where any is large enough

  /// False where no range was set: a value that is reported only.
  bool is_held() const {
    return low > -std::numeric_limits<double>::infinity() ||
           high < std::numeric_limits<double>::infinity();
  }
  bool holds() const { return measured >= low && measured <= high; }  ///< false for NaN
};

/// True if every row holds.
bool all_hold(std::span<const Row> rows);

/// The rows as an HTML element; those that do not hold stand out.
std::string html(std::span<const Row> rows);

}  // namespace airlight
