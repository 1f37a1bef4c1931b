#pragma once
/// What a user can say, as data: the source of `airlight list` and of docs/scene-reference.md. All
/// of it is taken from `describe`, `name` and `meaning`.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "scene/described.h"

namespace airlight {

struct ParameterEntry {
  std::string key;
  std::string accepted;       ///< with unit and range
  std::string default_value;  ///< as a file would say it; "required" or "none" where there is none
  std::string meaning;
};

/// A member of a family, or a table of the scene file.
struct MemberEntry {
  std::string name;
  std::string meaning;
  std::vector<ParameterEntry> parameters;
};

struct Chapter {
  std::string title;
  std::string text;
  std::vector<MemberEntry> members;
};

/// A default as a file would say it.
template <class T>
std::string default_text(const T& value) {
  if constexpr (is_required<T>) {
    return "required";
  } else if constexpr (is_optional<T> || is_list<T>) {
    return "none";
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_same_v<T, Rgb<double>>) {
    return value.r == value.g && value.g == value.b
               ? fmt::format("{}", value.r)
               : fmt::format("[{}, {}, {}]", value.r, value.g, value.b);
  } else if constexpr (std::is_same_v<T, Vec3<double>>) {
    return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
  } else if constexpr (tuple_size<T> > 0) {
    return fmt::format("[{}]", fmt::join(value, ", "));
  } else if constexpr (std::is_same_v<T, std::string>) {
    return value.empty() ? "none" : fmt::format("\"{}\"", value);
  } else if constexpr (std::is_enum_v<T>) {
    for (const Word<T>& word : words<T>)
      if (word.value == value) return fmt::format("\"{}\"", word.text);
    return "";
  } else if constexpr (is_family<T>) {
    return std::visit([](const auto& member) { return std::string(member.name); }, value);
  } else {
    return "see there";
  }
}

/// The meaning, and that of each word if the member takes words.
template <class T>
std::string full_meaning(const char* meaning) {
  std::string text = meaning;
  if constexpr (Worded<T>)
    for (const Word<T>& word : words<T>)
      text += fmt::format("{} {}: {}", text == meaning ? ":" : ";", word.text, word.meaning);
  return text;
}

/// The parameters that T itself describes, without those of the structs it is derived from.
template <Described T>
std::vector<ParameterEntry> parameters_of() {
  std::vector<ParameterEntry> parameters;
  const T defaults{};
  T::describe([&]<class Owner, class Member>(const char* key, Member Owner::*member,
                                             const char* unit, const Range& range,
                                             const char* meaning) {
    if constexpr (std::is_same_v<Owner, T>)
      parameters.push_back({key, accepted<Member>(range, unit), default_text(defaults.*member),
                            full_meaning<Member>(meaning)});
  });
  return parameters;
}

/// The members of a family with their own parameters.
template <class Family>
std::vector<MemberEntry> members_of() {
  std::vector<MemberEntry> members;
  for_each_member<Family>([&]<class Member>(const Member&) {
    MemberEntry entry{Member::name, Member::meaning, {}};
    if constexpr (Described<Member>) entry.parameters = parameters_of<Member>();
    members.push_back(std::move(entry));
  });
  return members;
}

/// Everything a scene file may say.
std::vector<Chapter> scene_reference();

/// For a terminal, 100 columns wide.
std::string as_text(const std::vector<Chapter>& chapters);

/// For a page: a table of parameters for each member.
std::string as_markdown(const std::vector<Chapter>& chapters);

}  // namespace airlight
