#pragma once
/// Reads a document into described structs: everything it accepts and everything it says about a
/// mistake comes from `describe`. A key that is absent leaves the member as it was.
#include <fmt/format.h>

#include "scene/cursor.h"
#include "scene/described.h"

namespace airlight {

/// One `field(...)` of a description but its member.
struct Field {
  const char* unit = unit::none;
  Range range;
  const char* meaning = "";
};

template <class T>
void read(const Cursor& at, T& value, const Field& field);

/// What to say after a value that is not accepted: "a number in (-1, 1) (eccentricity; ...)".
template <class T>
std::string hint(const Field& field) {
  const std::string text = accepted<T>(field.range, field.unit);
  return *field.meaning ? fmt::format("{} ({})", text, field.meaning) : text;
}

/// A finite number inside the range. `wanted` tells what the whole member takes.
inline double read_number(const Cursor& at, const Range& range, const std::string& wanted) {
  double x = 0;
  if (const auto* number = std::get_if<double>(&at.value().data))
    x = *number;
  else if (const auto* whole = std::get_if<std::int64_t>(&at.value().data))
    x = double(*whole);
  else
    at.refuse("is not a number: " + wanted);
  if (!std::isfinite(x)) at.refuse("is not finite: " + wanted);
  // Beyond, squares would leave single precision.
  if (std::abs(x) > far_away) at.refuse("is out of range, as is all beyond 1e18: " + wanted);
  if (!range.contains(x)) at.refuse("is out of range: " + wanted);
  return x;
}

inline std::int64_t read_whole(const Cursor& at, const Range& range, const std::string& wanted) {
  if (!at.value().moment.empty()) return std::llround(read_number(at, range, wanted));
  const auto* number = std::get_if<std::int64_t>(&at.value().data);
  if (!number) at.refuse("is not a whole number: " + wanted);
  if (!range.contains(double(*number))) at.refuse("is out of range: " + wanted);
  return *number;
}

/// A path set a part of something that is not said and has no default.
[[noreturn]] inline void refuse_part(const Cursor& at) {
  at.complain("is not there; only as a whole can it be set");
}

/// Exactly `count` numbers; what a sparse list leaves out stays.
inline void read_numbers(const Cursor& at, double* numbers, std::size_t count, const Range& range,
                         const std::string& wanted) {
  if (at.value().is_sparse) {
    std::vector<std::string> indices;
    for (std::size_t i = 0; i < count; ++i) {
      indices.push_back(std::to_string(i));
      if (const auto found = at.find(indices[i])) numbers[i] = read_number(*found, range, wanted);
    }
    for (const auto& [key, unused] : *at.value().table())
      if (std::ranges::find(indices, key) == indices.end())
        at.unknown(key, accepted_words(indices));
    return;
  }
  const Value::Array* array = at.value().array();
  if (!array) at.refuse("is not a list of numbers: " + wanted);
  if (array->size() != count)
    at.refuse(fmt::format("has {} numbers, not {}: {}", array->size(), count, wanted));
  for (std::size_t i = 0; i < count; ++i) numbers[i] = read_number(at.element(i), range, wanted);
}

/// The keys of a described struct.
template <Described T>
std::vector<std::string> keys_of() {
  std::vector<std::string> keys;
  T::describe([&](const char* key, auto&&...) { keys.push_back(key); });
  return keys;
}

/// The parameters of a described struct from a table, which may have one more key, `besides`.
template <Described T>
void read_table(const Cursor& at, T& value, const char* besides = nullptr) {
  const Value::Table* table = at.value().table();
  if (!table) at.refuse("is not a table");
  std::vector<std::string> keys = keys_of<T>();
  if (besides) keys.push_back(besides);
  for (const auto& [key, unused] : *table)
    if (std::ranges::find(keys, key) == keys.end())
      at.unknown(key, keys.empty() ? "nothing" : accepted_words(keys));
  T::describe(
      [&](const char* key, auto member, const char* unit, const Range& range, const char* meaning) {
        using Member = std::remove_cvref_t<decltype(value.*member)>;
        const Field field{unit, range, meaning};
        if (const auto found = at.find(key)) read(*found, value.*member, field);
        if constexpr (is_required<Member>)
          if (!(value.*member).value) at.lacks(key, hint<Member>(field));
      });
}

/// A table whose type an override changed, without what the file says for other types.
template <class Family, class Member>
Value for_new_type(const Cursor& at) {
  Value result = at.value();
  std::vector<std::string> others;
  for_each_member<Family>([&](auto member) {
    for (std::string& key : keys_of<decltype(member)>()) others.push_back(std::move(key));
  });
  const std::vector<std::string> own = keys_of<Member>();
  std::erase_if(std::get<Value::Table>(result.data), [&](const auto& entry) {
    const auto& [key, given] = entry;
    return std::ranges::find(others, key) != others.end() &&
           std::ranges::find(own, key) == own.end() && !given.overridden();
  });
  return result;
}

/// The member of a family that the key "type" names.
template <class Family>
void read_family(const Cursor& at, Family& value) {
  if (!at.value().table()) at.refuse("is not a table: " + accepted<Family>({}, unit::none));
  const auto type = at.find("type");
  if (!type) at.lacks("type", "accepted: " + family_words<Family>());
  const auto* word = std::get_if<std::string>(&type->value().data);
  bool known = false;
  for_each_member<Family>([&](auto member) {
    if (!word || *word != member.name) return;
    known = true;
    if (type->value().place.is_override()) {
      const Value table = for_new_type<Family, decltype(member)>(at);
      read_table(at.instead(table), member, "type");
    } else {
      read_table(at, member, "type");
    }
    value = member;
  });
  if (!known) type->refuse("is not known here; accepted: " + family_words<Family>());
}

template <class T>
void read(const Cursor& at, T& value, const Field& field) {
  if constexpr (is_optional<T> || is_required<T> || is_list<T>)
    if (at.value().is_sparse) refuse_part(at);
  if constexpr (is_optional<T>) {
    read(at, value.emplace(), field);
  } else if constexpr (is_required<T>) {
    read(at, value.value.emplace(), field);
  } else if constexpr (std::is_same_v<T, bool>) {
    const bool* flag = std::get_if<bool>(&at.value().data);
    if (!flag) at.refuse("is neither true nor false: " + hint<T>(field));
    value = *flag;
  } else if constexpr (std::is_integral_v<T>) {
    value = T(read_whole(at, field.range, hint<T>(field)));
  } else if constexpr (std::is_arithmetic_v<T>) {
    value = T(read_number(at, field.range, hint<T>(field)));
  } else if constexpr (std::is_same_v<T, Rgb<double>>) {
    if (at.value().array() || at.value().is_sparse) {
      double rgb[3] = {value.r, value.g, value.b};
      read_numbers(at, rgb, 3, field.range, hint<T>(field));
      value = {rgb[0], rgb[1], rgb[2]};
    } else {
      value = Rgb<double>(read_number(at, field.range, hint<T>(field)));
    }
  } else if constexpr (std::is_same_v<T, Vec3<double>>) {
    double xyz[3] = {value.x, value.y, value.z};
    read_numbers(at, xyz, 3, field.range, hint<T>(field));
    value = {xyz[0], xyz[1], xyz[2]};
  } else if constexpr (tuple_size<T> > 0) {
    read_numbers(at, value.data(), value.size(), field.range, hint<T>(field));
  } else if constexpr (std::is_same_v<T, std::string>) {
    const auto* text = std::get_if<std::string>(&at.value().data);
    if (!text) at.refuse("is not a text: " + hint<T>(field));
    value = *text;
  } else if constexpr (std::is_enum_v<T>) {
    const auto* text = std::get_if<std::string>(&at.value().data);
    bool known = false;
    for (const Word<T>& word : words<T>)
      if (text && *text == word.text) known = true, value = word.value;
    if (!known) at.refuse("is not known here; accepted: " + enum_words<T>());
  } else if constexpr (std::is_same_v<T, Value>) {
    value = at.value();
  } else if constexpr (is_list<T>) {
    const Value::Array* array = at.value().array();
    if (!array) at.refuse("is not a list: " + hint<T>(field));
    value.assign(array->size(), {});
    for (std::size_t i = 0; i < value.size(); ++i) read(at.element(i), value[i], field);
  } else if constexpr (is_family<T>) {
    read_family(at, value);
  } else {
    read_table(at, value);
  }
}

}  // namespace airlight
