#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace airlight {

/// Where a value stands: in a file, or in an override by path.
struct Place {
  std::shared_ptr<const std::string> source;  ///< the file as the user named it, or "-D path=value"
  int line = 0;                               ///< from 1; 0 where there are no lines
  int column = 0;                             ///< from 1

  bool is_override() const { return source && line == 0; }

  /// "fog.toml:14:24", or the override itself.
  std::string text() const;
};

/// What a file says, before anybody asks what it means: the values of a TOML document, each with
/// its place.
struct Value {
  using Array = std::vector<Value>;
  using Table = std::map<std::string, Value>;
  /// A date or a time, which no parameter takes; kept as text for the error.
  struct Date {
    std::string text;
  };

  std::variant<Table, Array, std::string, double, std::int64_t, bool, Date> data;
  Place place;             ///< of the value
  Place key_place;         ///< of its key, if it has one
  bool is_sparse = false;  ///< a table of some elements of a list, by their indices
  /// Of a number worked out from an animation, for errors: "at frame 17, between the keys at 3:8
  /// and 3:13". A whole number is the nearest one.
  std::string moment = {};

  const Table* table() const { return std::get_if<Table>(&data); }
  const Array* array() const { return std::get_if<Array>(&data); }

  /// Where an override changed this value or a part of it; null if none did.
  const Place* overridden() const;

  /// As a file would say it, cut after a few dozen characters.
  std::string text() const;
};

/// A change of one value of a document by its path: "lights.0.irradiance=3".
struct Override {
  std::string path;   ///< keys and indices, separated by dots
  std::string value;  ///< a TOML value; a bare word stands for itself in quotes
  std::string said;   ///< how the user said it, for errors

  /// Takes "path=value". Throws Error if there is no path before a "=".
  Override(const std::string& assignment);
  Override(const char* assignment) : Override(std::string(assignment)) {}
  Override(std::string path, std::string value, std::string said);
};

/// Parses TOML; `name` stands for the text in errors. Throws Error: "fog.toml:3:7: ...".
Value parse_document(const std::string& text, const std::string& name);

/// The same from a file.
Value read_document(const std::filesystem::path& path);

/// A text as a TOML value, in quotes.
std::string toml_text(const std::string& text);

/// Whether a path names the value at `whole` or a part of it.
bool is_within(const std::string& path, const std::string& whole);

/// Sets the value at a path (keys and indices, separated by dots). Tables on the way are made where
/// they are missing; elements of arrays must be there, or the array must be missing: it is then a
/// sparse one. Throws Error, with the place of the value's key, if the path leads nowhere.
void replace(const std::string& path, Value value, Value& document);

/// The same for an override. Throws Error also if its value is none.
void apply(const Override& change, Value& document);

}  // namespace airlight
