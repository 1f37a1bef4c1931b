#include "scene/ways.h"

#include <fmt/format.h>

#include <algorithm>

namespace airlight {
namespace {

bool contains(const Way& keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

bool contains_all(const Way& keys, const Way& some) {
  return std::ranges::all_of(some, [&](const auto& key) { return contains(keys, key); });
}

std::string joined(const Way& keys) { return fmt::format("{}", fmt::join(keys, " and ")); }

}  // namespace

std::size_t way_taken(const Cursor& at, const std::vector<Way>& ways) {
  Way given, overridden;
  std::vector<std::string> accepted;
  for (const Way& way : ways) {
    accepted.push_back(joined(way));
    for (const std::string& key : way) {
      const auto found = at.find(key);
      if (!found || contains(given, key)) continue;
      given.push_back(key);
      if (found->value().overridden()) overridden.push_back(key);
    }
  }
  // What must be said by the way taken: all that is given, or what overrides say of it.
  const Way& meant = overridden.empty() ? given : overridden;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!meant.empty() && contains_all(ways[i], meant) && contains_all(given, ways[i])) return i;

  if (meant.empty()) at.complain(fmt::format("lacks {}", fmt::join(accepted, ", or ")));
  std::string found = "has " + joined(meant);
  for (const Way& way : ways) {
    if (!contains_all(way, meant)) continue;
    Way lacking = way;
    std::erase_if(lacking, [&](const auto& key) { return contains(given, key); });
    found += " without " + joined(lacking);
    break;
  }
  at.complain(fmt::format("{}; accepted: {}", found, fmt::join(accepted, ", or ")), meant);
}

}  // namespace airlight
