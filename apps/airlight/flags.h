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

/// A word that a flag takes for a number.
struct FlagWord {
  const char* key;
  const char* word;
  const char* value;
};

inline constexpr FlagWord flag_words[] = {{"samples_per_ray", "all", "0"}};

/// The word that the flag of a key takes; null if it takes none.
inline const FlagWord* word_of(const std::string& key) {
  const auto found = std::ranges::find(flag_words, key, &FlagWord::key);
  return found == std::end(flag_words) ? nullptr : found;
}

/// What the help says of a flag. A text needs no quotes on a command line.
template <class Member>
std::string flag_help(const char* meaning, const airlight::Range& range, const char* unit,
                      const FlagWord* word) {
  if constexpr (std::is_same_v<Member, std::string>) return meaning;
  const std::string help = fmt::format("{}: {}", meaning, airlight::accepted<Member>(range, unit));
  return word ? fmt::format("{}, or {} for {}", help, word->word, word->value) : help;
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
    const FlagWord* const word = word_of(key);
    verb.add_option_function<std::string>(
            flag,
            [&changes, flag, word, path = prefix + key](const std::string& value) {
              changes.emplace_back(path, word && value == word->word ? word->value : value,
                                   flag + " " + value);
            },
            flag_help<Member>(meaning, range, unit, word))
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
