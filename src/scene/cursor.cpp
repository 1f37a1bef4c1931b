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
  throw Error(fmt::format("{}: {} = {} {}", value_->place.text(), path_, value_->text(), what));
}

void Cursor::complain(std::string_view what) const {
  throw Error(
      fmt::format("{}: {} {}", value_->place.text(), path_.empty() ? "the scene" : path_, what));
}

void Cursor::lacks(const std::string& key, std::string_view accepted) const {
  throw Error(fmt::format("{}: {} is missing; {}", value_->place.text(), path_of(key), accepted));
}

void Cursor::unknown(const std::string& key, std::string_view accepted) const {
  throw Error(fmt::format("{}: {} is not known here; accepted: {}",
                          value_->table()->at(key).key_place.text(), path_of(key), accepted));
}

}  // namespace airlight
