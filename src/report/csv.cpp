#include "report/csv.h"

#include <fmt/format.h>

#include <cmath>

namespace airlight {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == field.npos) return field;
  std::string out = "\"";
  for (const char c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string field(double value) { return std::isnan(value) ? "" : fmt::format("{:.9g}", value); }

std::string heading(const Column& column, const char* what) {
  std::string name = column.name + what;
  if (!column.unit.empty()) name += fmt::format(" [{}]", column.unit);
  return quoted(name);
}

}  // namespace

std::string csv(const Table& table) {
  check_shape(table);
  if (table.columns.empty()) return "";
  std::vector<bool> spreads(table.columns.size());
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      if (!std::isnan(row[c].spread)) spreads[c] = true;

  std::string out;
  const auto end_line = [&] { out.back() = '\n'; };  // the comma after the last field
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    out.append(heading(table.columns[c], "")) += ',';
    if (spreads[c]) out.append(heading(table.columns[c], " spread")) += ',';
  }
  end_line();
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      out.append(row[c].is_number ? field(row[c].value) : quoted(row[c].text)) += ',';
      if (spreads[c]) out.append(field(row[c].spread)) += ',';
    }
    end_line();
  }
  return out;
}

}  // namespace airlight
