#pragma once
#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

/// The numbers of a text such as "1.2,1,0.8"; none if it is anything else.
template <class Number = double>
std::vector<Number> numbers(std::string_view text, char separator) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    Number number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc()) return {};
    numbers.push_back(number);
    if (rest == end) return numbers;
    if (*rest != separator) return {};
    at = rest + 1;
  }
}

/// The whole numbers of a text such as "640x360" or "0,0,64,32"; none if it is anything else.
inline std::vector<std::int64_t> whole_numbers(std::string_view text, char separator) {
  return numbers<std::int64_t>(text, separator);
}
