#pragma once
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace airlight {

/// What stands in a table: words, or a number with or without the spread it has over the seeds.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}
  Cell(const char* words) : text(words) {}
  Cell(std::integral auto whole) : value(double(whole)), is_number(true) {}
  Cell(double value, double spread = std::numeric_limits<double>::quiet_NaN())
      : value(value), spread(spread), is_number(true) {}

  std::string text;
  double value = 0;
  double spread = std::numeric_limits<double>::quiet_NaN();  ///< NaN: has none
  bool is_number = false;
};

/// Which value of a column is the best one.
enum class Best { none, lowest, highest };

struct Column {
  std::string name = "";
  std::string unit = "";   ///< printed below the name; "" has none
  Best best = Best::none;  ///< its cells are set in bold
  int digits = 4;          ///< significant digits of numbers without a spread
};

/// Rows of named columns. One table gives both what is read and what is plotted from:
/// HTML through `Page::table`, CSV through `csv`.
struct Table {
  std::string caption = "";
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};  ///< each as long as `columns`

  /// Column whose equal neighbours make a group: a line is drawn between groups, and the best value
  /// is looked for in each of them (the best estimator at each number of samples, say).
  std::optional<std::size_t> group_by = std::nullopt;
};

/// Throws Error if a row is not as long as the list of columns, or `group_by` names none of them.
void check_shape(const Table& table);

/// The table as an HTML element, without its caption: numbers to the right, the best of each group
/// in bold. Throws Error as `check_shape` does.
std::string html(const Table& table);

}  // namespace airlight
