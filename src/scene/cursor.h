#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.h"

namespace airlight {

/// A value of a document together with its path, which is what an error needs to say.
class Cursor {
 public:
  explicit Cursor(const Value& root) : value_(&root) {}

  const Value& value() const { return *value_; }
  const std::string& path() const { return path_; }

  /// The value of a key, if this is a table that has it.
  std::optional<Cursor> find(const std::string& key) const;
  /// The same, or this value itself where the key is absent: for complaints about either.
  Cursor at_or_here(const std::string& key) const;
  /// An element of an array; i must be below its size.
  Cursor element(std::size_t i) const;
  /// Another value read in this one's stead; it must outlive the cursor.
  Cursor instead(const Value& value) const { return {value, path_}; }

  /// The path of a key of this table.
  std::string path_of(const std::string& key) const;

  /// Throws "fog.toml:14:24: media.0.phase.k = 1.2 <what>".
  [[noreturn]] void refuse(std::string_view what) const;
  /// Throws "fog.toml:14:1: media.0 <what>", the value itself left out, or at an override of a
  /// part of it. A complaint `about` some keys stands at the first of them that an override
  /// changed, or else at the first that is there.
  [[noreturn]] void complain(std::string_view what,
                             const std::vector<std::string>& about = {}) const;
  /// Throws "fog.toml:14:1: media.0.shape is missing; <accepted>", at the override that asked for a
  /// type with that key if there is one.
  [[noreturn]] void lacks(const std::string& key, std::string_view accepted) const;
  /// Throws "fog.toml:9:1: media.0.sigma_q is not known here; accepted: <accepted>", at the key.
  [[noreturn]] void unknown(const std::string& key, std::string_view accepted) const;

 private:
  Cursor(const Value& value, std::string path) : value_(&value), path_(std::move(path)) {}

  const Value* value_;
  std::string path_;
};

}  // namespace airlight
