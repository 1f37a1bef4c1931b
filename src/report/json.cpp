#include "report/json.h"

#include <nlohmann/json.hpp>

namespace airlight {

std::string json(std::span<const Row> rows) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const Row& row : rows)
    all.push_back({{"label", row.label},
                   {"published", row.published ? Json(*row.published) : Json(nullptr)},
                   {"measured", row.measured},
                   {"low", row.low},
                   {"high", row.high}});
  // Numbers that JSON does not have come out as null.
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace airlight
