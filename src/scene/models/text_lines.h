#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace airlight {

/// OBJ and MTL files as text: lines of words, of which the first is a key.

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The text after leading blanks and up to the next end of line, which is taken away from `rest`.
inline std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find_first_of("\r\n");
  std::string_view line = rest.substr(0, end);
  const bool two = end != rest.npos && rest.substr(end, 2) == "\r\n";
  rest.remove_prefix(end == rest.npos ? rest.size() : end + (two ? 2 : 1));
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

/// The first word of a line, which is taken away from it; empty if there is none.
inline std::string_view next_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// A line as an error shows it: its beginning, without bytes that a terminal would act on.
inline std::string shown(std::string_view line) {
  constexpr std::size_t most = 60;
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::string text(line.substr(0, most));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = '?';
  return line.size() > most ? text + "..." : text;
}

/// Stands for a blank inside a name, where the parser would end it.
constexpr char joint = '\x1f';

/// The end of a name that goes on to the end of its line, from `begin` on: without blanks behind
/// it, and without a comment, whose # stands alone ("Material #25" is a name).
inline std::size_t end_of_name(std::string_view line, std::size_t begin) {
  std::size_t end = line.find_first_of("\r\n", begin);
  if (end == line.npos) end = line.size();
  for (std::size_t i = begin + 1; i < end; ++i)
    if (line[i] == '#' && is_blank(line[i - 1]) && (i + 1 == end || is_blank(line[i + 1]))) end = i;
  while (end > begin && is_blank(line[end - 1])) --end;
  return end;
}

/// Calls `visit(key, words, line, number)` for each line, which count from 1.
template <class Visit>
void for_each_line(std::string_view text, Visit&& visit) {
  for (std::int64_t number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    std::string_view words = line;
    const std::string_view key = next_word(words);
    visit(key, words, line, number);
  }
}

}  // namespace airlight
