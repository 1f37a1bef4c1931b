#pragma once
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

/// The command line without the program's name, last word first as the parser wants it. `--preview`
/// may stand without its seconds: it takes the next word only if that is a number.
inline std::vector<std::string> arguments(int argc, char** argv) {
  constexpr const char* preview_seconds = "2";
  const auto is_number = [](std::string_view word) {
    double number = 0;
    return std::from_chars(word.data(), word.data() + word.size(), number).ptr ==
               word.data() + word.size() &&
           !word.empty();
  };
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == "--preview" && (i + 1 == words.size() || !is_number(words[i + 1])))
      words[i] = std::string("--preview=") + preview_seconds;
  std::ranges::reverse(words);
  return words;
}
