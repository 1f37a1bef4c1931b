#include "scene/cursor.h"

#include <fmt/format.h>

#include "error.h"

namespace airlight {

std::optional<Cursor> Cursor::find(const std::string& key) const {
  const Value::Table* table = value_->table();
  if (!table || !table->contains(key)) return std::nullopt;
  return Cursor(table->at(key), path_of(key));
}

Cursor Cursor::at_or_here(const std::string& key) const { return find(key).value_or(*this); }

Cursor Cursor::element(std::size_t i) const {
  return {value_->array()->at(i), path_of(std::to_string(i))};
}

std::string Cursor::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Cursor::refuse(std::string_view what) const {
  const std::string& moment = value_->moment;
  throw Error(fmt::format("{}: {} = {}{} {}", value_->place.text(), path_, value_->text(),
                          moment.empty() ? "" : ", " + moment + ",", what));
}

void Cursor::complain(std::string_view what, const std::vector<std::string>& about) const {
  const Place* changed = about.empty() ? value_->overridden() : nullptr;
  const Place* there = nullptr;
  for (const std::string& key : about)
    if (const auto found = find(key)) {
      if (!changed) changed = found->value().overridden();
      if (!there) there = &found->value().place;
    }
  const Place& place = changed ? *changed : there ? *there : value_->place;
  throw Error(fmt::format("{}: {} {}", place.text(), path_.empty() ? "the scene" : path_, what));
}

void Cursor::lacks(const std::string& key, std::string_view accepted) const {
  const auto type = find("type");
  const bool asked = type && type->value().place.is_override();
  const Place& place = asked ? type->value().place : value_->place;
  throw Error(fmt::format("{}: {} is missing; {}", place.text(), path_of(key), accepted));
}

void Cursor::unknown(const std::string& key, std::string_view accepted) const {
  throw Error(fmt::format("{}: {} is not known here; accepted: {}",
                          value_->table()->at(key).key_place.text(), path_of(key), accepted));
}

}  // namespace airlight
