#include "scene/models/mtl_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "error.h"
#include "scene/models/text_lines.h"

namespace airlight {
namespace {

/// A number if the whole word is one; words such as "nan" are.
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double x = 0;
  const char* end = word.data() + word.size();
  const auto [rest, problem] = std::from_chars(word.data(), end, x);
  if (word.empty() || problem != std::errc() || rest != end) return std::nullopt;
  return x;
}

bool is_colour(std::string_view key) { return key == "Kd" || key == "Kt" || key == "Tf"; }
bool is_part(std::string_view key) { return key == "d" || key == "Tr"; }

/// Gives each option of a texture's line three numbers.
void complete_options(std::string& line) {
  for (const char* option : {" -o ", " -s ", " -t "}) {
    std::size_t end = line.find(option);
    if (end == line.npos) continue;
    end += 3;
    int numbers = 0;
    for (; numbers < 3; ++numbers) {
      const std::size_t begin = std::min(line.find_first_not_of(' ', end), line.size());
      const std::size_t stop = std::min(line.find(' ', begin), line.size());
      if (!number_of(line.substr(begin, stop - begin))) break;
      end = stop;
    }
    for (; numbers < 3; ++numbers) line.insert(end, option[2] == 's' ? " 1" : " 0");
  }
}

}  // namespace

std::optional<std::string> check_mtl_numbers(std::string_view text, const std::string& file) {
  std::string first;
  int outside = 0;
  for_each_line(text, [&](auto key, auto words, auto line, std::int64_t at) {
    if (!is_colour(key) && !is_part(key)) return;
    int given = 0, numbers = 0;
    bool inside = true;
    const int most = is_part(key) ? 1 : 3;
    for (std::string_view word; given < most && !(word = next_word(words)).empty(); ++given) {
      const auto x = number_of(word);
      if (!x || !std::isfinite(*x)) break;
      ++numbers;
      inside = inside && *x >= 0 && *x <= 1;
    }
    const bool rest_is_empty = next_word(words).empty();
    if (numbers != most && !(numbers == 1 && given == 1 && rest_is_empty))
      throw Error(fmt::format(
          "{}:{}: \"{}\" lacks numbers; accepted: {}", file, at, shown(line),
          is_part(key) ? "one finite number" : "three finite numbers, or one for all three"));
    if (!inside && outside++ == 0)
      first = fmt::format("{}:{}: \"{}\" leaves [0, 1]: the nearest number in it counts", file, at,
                          shown(line));
  });
  if (outside == 0) return std::nullopt;
  return outside > 1 ? fmt::format("{} ({} such lines in all)", first, outside) : first;
}

std::string complete_mtl(std::string_view text, std::vector<std::string>& colourless) {
  std::string result, name;
  bool has_colour = true, has_picture = false;
  const auto finish_material = [&] {
    if (has_colour) return;
    result += has_picture ? "Kd 1 1 1\n" : "Kd 0.5 0.5 0.5\n";
    if (!has_picture) colourless.push_back(name);
  };
  for_each_line(text, [&](auto key, auto words, auto line, auto) {
    std::string completed(line);
    if (key == "newmtl") {
      finish_material();
      has_colour = has_picture = false;
      while (!words.empty() && is_blank(words.front())) words.remove_prefix(1);
      name = words.substr(0, end_of_name(words, 0));
      completed = "newmtl " + name;
      std::replace_if(completed.begin() + 7, completed.end(), is_blank, joint);
    } else if (is_colour(key)) {
      const std::string_view number = next_word(words);
      if (next_word(words).empty()) completed += fmt::format(" {} {}", number, number);
    } else {
      complete_options(completed);
    }
    has_colour = has_colour || key == "Kd";
    has_picture = has_picture || key == "map_Kd";
    result += completed + '\n';
  });
  finish_material();
  return result;
}

}  // namespace airlight
