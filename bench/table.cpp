#include "table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace airlight::bench {
namespace {

constexpr int columns = 5;
using Line = std::array<std::string, columns>;

Line line_of(const Row& row) {
  const std::string holds = row.must.be == Must::Be::anything && row.holds() ? ""
                            : row.holds()                                    ? "yes"
                                                                             : "NO";
  return {row.name, fmt::format("{:.4g} {}", row.value, row.unit), row.must.text(), holds, row.isa};
}

}  // namespace

std::string table(const std::vector<Row>& rows) {
  std::vector<Line> lines = {{"row", "measured", "must reach", "holds", "instruction set"}};
  for (const Row& row : rows) lines.push_back(line_of(row));
  std::array<std::size_t, columns> width = {};
  for (const Line& line : lines)
    for (int c = 0; c < columns; ++c) width[c] = std::max(width[c], line[c].size());
  std::string text;
  for (const Line& line : lines) {
    std::string padded;
    for (int c = 0; c < columns; ++c)
      padded += fmt::format("{:<{}}{}", line[c], width[c], c + 1 < columns ? " | " : "");
    text += padded.substr(0, padded.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string to_json(const std::vector<Row>& rows) {
  auto list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json must;
    if (row.must.be != Must::Be::anything) must = row.must.text();
    list.push_back({{"name", row.name},
                    {"value", row.value},
                    {"unit", row.unit},
                    {"must", must},
                    {"holds", row.holds()}});
  }
  return list.dump(2) + "\n";  // the library writes NaN and infinities as null
}

}  // namespace airlight::bench
