#pragma once
#include <airlight/describe.h>
#include <airlight/math/vec.h>

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "scene/accepted.h"
#include "scene/document.h"
#include "scene/required.h"

namespace airlight {

/// The kinds of members that `describe` may name, told apart at compile time.

/// A struct whose parameters are described.
template <class T>
concept Described = requires {
  T::describe([](auto&&...) {});
};

/// An enum whose words are listed.
template <class T>
concept Worded = std::is_enum_v<T> && std::size(words<T>)
> 0;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_required = false;
template <class T>
inline constexpr bool is_required<Required<T>> = true;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

/// A fixed number of numbers, such as the four of a plane.
template <class T>
inline constexpr std::size_t tuple_size = 0;
template <std::size_t n>
inline constexpr std::size_t tuple_size<std::array<double, n>> = n;

/// A variant of described structs, told apart by the key "type".
template <class T>
inline constexpr bool is_family = false;
template <class... Members>
inline constexpr bool is_family<std::variant<Members...>> = true;

/// Calls `visit(Member{})` for every member of a family.
template <class Family, class Visit>
void for_each_member(Visit&& visit) {
  [&]<class... Members>(std::type_identity<std::variant<Members...>>) {
    (visit(Members{}), ...);
  }(std::type_identity<Family>{});
}

/// The words that a family's "type" takes.
template <class Family>
std::string family_words() {
  std::vector<std::string> names;
  for_each_member<Family>([&](const auto& member) { names.push_back(member.name); });
  return accepted_words(std::move(names));
}

template <Worded E>
std::string enum_words() {
  std::vector<std::string> texts;
  for (const Word<E>& word : words<E>) texts.push_back(word.text);
  return accepted_words(std::move(texts));
}

/// What a member of type T takes, in words.
template <class T>
std::string accepted(const Range& range, const char* unit) {
  if constexpr (is_required<T> || is_optional<T>) {
    using Inner = std::remove_cvref_t<decltype(*std::declval<T&>())>;
    return accepted<Inner>(range, unit);
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return accepted_number(range, unit, std::is_integral_v<T>);
  } else if constexpr (std::is_same_v<T, Rgb<double>>) {
    return accepted_numbers("a number or [r, g, b]", range, unit);
  } else if constexpr (std::is_same_v<T, Vec3<double>>) {
    return accepted_numbers("[x, y, z]", range, unit);
  } else if constexpr (tuple_size<T> > 0) {
    return accepted_numbers("a list of " + std::to_string(tuple_size<T>) + " numbers", range, unit);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "a text in quotes";
  } else if constexpr (std::is_enum_v<T>) {
    return "one of " + enum_words<T>();
  } else if constexpr (std::is_same_v<T, Value>) {
    return "what the value at the path takes";
  } else if constexpr (is_list<T>) {
    using Element = typename T::value_type;
    if constexpr (Described<Element> || is_family<Element>)
      return "a list of tables";
    else
      return "a list, each " + accepted<Element>(range, unit);
  } else if constexpr (is_family<T>) {
    return "a table with a type: " + family_words<T>();
  } else {
    static_assert(Described<T>, "describe() names a member of a kind that is not known");
    return "a table";
  }
}

}  // namespace airlight
