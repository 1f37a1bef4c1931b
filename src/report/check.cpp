#include "report/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/text.h"

namespace airlight {
namespace {

std::string range(double low, double high) {
  if (low == -INFINITY && high == INFINITY) return "any";
  if (low == -INFINITY) return "≤ " + number(high);
  if (high == INFINITY) return "≥ " + number(low);
  return number(low) + " … " + number(high);
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
        row.holds() ? "holds" : "fails", rich(row.label),
        row.published ? number(*row.published) : "", number(row.measured), range(row.low, row.high),
        row.holds() ? "✓ holds" : "✗ fails");
  return out + "</tbody>\n</table>\n";
}

}  // namespace airlight
