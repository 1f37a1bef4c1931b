#include "report/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace airlight {

std::string json(std::span<const Row> rows) {
  using Json = nlohmann::ordered_json;
  const auto finite = [](double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); };
  Json all = Json::array();
  for (const Row& row : rows)
    all.push_back({{"label", row.label},
                   {"published", row.published ? finite(*row.published) : Json(nullptr)},
                   {"measured", finite(row.measured)},
                   {"low", finite(row.low)},
                   {"high", finite(row.high)}});
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace airlight
