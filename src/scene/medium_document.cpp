#include "scene/medium_document.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace airlight {

Medium MediumDocument::medium(const Cursor& at) const {
  std::vector<std::string> given;
  const auto note = [&](const char* key, bool is_given) {
    if (is_given) given.push_back(key);
  };
  note("albedo", albedo.has_value());
  note("sigma_a", sigma_a.has_value());
  note("sigma_s", sigma_s.has_value());
  note("sigma_t", sigma_t.has_value());
  note("visibility", visibility.has_value());

  Medium medium;
  using Keys = std::vector<std::string>;
  if (given == Keys{"sigma_a", "sigma_s"}) {
    medium.sigma_s = *sigma_s;
    medium.sigma_t = *sigma_s + *sigma_a;
  } else if (given == Keys{"albedo", "sigma_t"}) {
    medium.sigma_s = *albedo * *sigma_t;
    medium.sigma_t = *sigma_t;
  } else if (given == Keys{"albedo", "visibility"}) {
    medium.sigma_t = Rgb<double>(3.912 / *visibility);  // Koschmieder: ln 50
    medium.sigma_s = *albedo * medium.sigma_t;
  } else {
    at.complain(fmt::format(
        "has {}; accepted: sigma_s and sigma_a, or albedo and sigma_t, or "
        "albedo and visibility",
        given.empty() ? "no coefficients" : fmt::format("{}", fmt::join(given, " and "))));
  }
  medium.emission = emission;
  medium.phase = phase;
  medium.shape = shape_of(*shape, at.at_or_here("shape"));
  return medium;
}

}  // namespace airlight
