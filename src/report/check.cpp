#include "report/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/text.h"

namespace airlight {
namespace {

std::string range(const Row& row) {
  const auto [low, high] = std::pair(row.low, row.high);
  if (!row.is_held()) return "";
  if (low == -INFINITY) return "≤ " + number(high);
  if (high == INFINITY) return "≥ " + number(low);
  return number(low) + " … " + number(high);
}

const char* verdict(const Row& row) {
  if (!row.holds()) return "✗ fails";
  return row.is_held() ? "✓ holds" : "reported";
}

}  // namespace

bool all_hold(std::span<const Row> rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.holds(); });
}

std::string html(std::span<const Row> rows) {
  std::string out =
      "<table>\n<thead><tr><th></th><th class=\"number\">published</th><th "
      "class=\"number\">measured</th>"
      "<th class=\"number\">must lie in</th><th></th></tr></thead>\n<tbody>\n";
  for (const Row& row : rows)
    out += fmt::format(
        "<tr class=\"{}\"><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td class=\"verdict\">{}</td></tr>\n",
        !row.holds()    ? "fails"
        : row.is_held() ? "holds"
                        : "reported",
        rich(row.label), row.published ? number(*row.published) : "", number(row.measured),
        range(row), verdict(row));
  return out + "</tbody>\n</table>\n";
}

}  // namespace airlight
