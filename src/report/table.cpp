#include "report/table.h"

#include <fmt/format.h>

#include <cmath>

#include "error.h"
#include "report/text.h"

namespace airlight {
namespace {

/// Whether two cells belong to one group.
bool alike(const Cell& a, const Cell& b) {
  return a.is_number == b.is_number && a.text == b.text && (!a.is_number || a.value == b.value);
}

/// The best number of column c in rows [first, last); NaN where there is none to choose.
double best_of(const Table& table, std::size_t c, std::size_t first, std::size_t last) {
  double best = std::nan("");
  if (table.columns[c].best == Best::none || last - first < 2) return best;
  for (std::size_t r = first; r < last; ++r) {
    const Cell& cell = table.rows[r][c];
    if (!cell.is_number || std::isnan(cell.value)) continue;
    const bool lowest = table.columns[c].best == Best::lowest;
    if (std::isnan(best) || (lowest ? cell.value < best : cell.value > best)) best = cell.value;
  }
  return best;
}

}  // namespace

std::string html(const Table& table) {
  check_shape(table);
  std::vector<bool> numeric(table.columns.size());
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      if (row[c].is_number) numeric[c] = true;
  const auto align = [&](std::size_t c) { return numeric[c] ? " class=\"number\"" : ""; };

  std::string out = "<table>\n<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    out += fmt::format("<th{}>{}", align(c), rich(column.name));
    if (!column.unit.empty())
      out += fmt::format("<span class=\"unit\">{}</span>", rich(column.unit));
    out += "</th>";
  }
  out += "</tr></thead>\n";

  for (std::size_t first = 0, last = 0; first < table.rows.size(); first = last) {
    const auto same = [&](std::size_t r) {
      return !table.group_by ||
             alike(table.rows[r][*table.group_by], table.rows[first][*table.group_by]);
    };
    for (last = first + 1; last < table.rows.size() && same(last);) ++last;
    out += "<tbody>\n";
    for (std::size_t r = first; r < last; ++r) {
      out += "<tr>";
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const Cell& cell = table.rows[r][c];
        std::string text = cell.is_number ? number(cell.value, cell.spread, table.columns[c].digits)
                                          : rich(cell.text);
        if (cell.is_number && cell.value == best_of(table, c, first, last))
          text = "<b>" + text + "</b>";
        out += fmt::format("<td{}>{}</td>", align(c), text);
      }
      out += "</tr>\n";
    }
    out += "</tbody>\n";
  }
  return out + "</table>\n";
}

void check_shape(const Table& table) {
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.rows[r].size() != table.columns.size())
      throw Error(fmt::format("table \"{}\": row {} has {} cells; there are {} columns",
                              table.caption, r + 1, table.rows[r].size(), table.columns.size()));
  if (table.group_by && *table.group_by >= table.columns.size())
    throw Error(fmt::format("table \"{}\": grouped by column {}; there are {} columns",
                            table.caption, *table.group_by + 1, table.columns.size()));
}

}  // namespace airlight
