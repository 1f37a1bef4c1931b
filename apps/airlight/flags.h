#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/reader.h"
#include "verb.h"

/// "--samples-per-ray" of "samples_per_ray".
inline std::string flag_of(std::string key) {
  std::ranges::replace(key, '_', '-');
  return "--" + key;
}

/// A flag for every parameter that T describes. What the user gives becomes a change of
/// `prefix` + key, so that it is read, and refused, as the same key of a file is. Keys in `without`
/// get none.
template <airlight::Described T>
void add_flags(CLI::App& verb, const std::string& prefix, const std::string& group,
               std::vector<airlight::Override>& changes,
               const std::vector<std::string>& without = {}) {
  T::describe([&](const std::string& key, auto member, const char* unit,
                  const airlight::Range& range, const char* meaning) {
    using Member = std::remove_cvref_t<decltype(std::declval<T>().*member)>;
    if (std::ranges::find(without, key) != without.end()) return;
    const std::string flag = flag_of(key);
    verb.add_option_function<std::string>(
            flag,
            [&changes, flag, path = prefix + key](const std::string& value) {
              changes.emplace_back(path, value, flag + " " + value);
            },
            fmt::format("{}: {}", meaning, airlight::accepted<Member>(range, unit)))
        ->type_name("")
        ->take_last()
        ->group(group);
  });
}

/// What changes say of a described struct. Throws Error in the words of the scene reader.
template <airlight::Described T>
T read_flags(const std::vector<airlight::Override>& changes) {
  airlight::Value document;
  for (const airlight::Override& change : changes) apply(change, document);
  T result;
  read_table(airlight::Cursor(document), result);
  return result;
}
