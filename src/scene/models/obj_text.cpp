#include "scene/models/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "error.h"
#include "scene/models/text_lines.h"

namespace airlight {
namespace {

enum class Kind : std::uint8_t { blank, digit, number, word };

constexpr std::array<Kind, 256> kinds = [] {
  std::array<Kind, 256> table{};
  table.fill(Kind::word);
  for (const char c : {' ', '\t', '\r'}) table[static_cast<unsigned char>(c)] = Kind::blank;
  for (const char c : {'+', '-', '.', 'e', 'E'})
    table[static_cast<unsigned char>(c)] = Kind::number;
  for (char c = '0'; c <= '9'; ++c) table[static_cast<unsigned char>(c)] = Kind::digit;
  return table;
}();

/// Whether the first `wanted` words are made of digits and their signs.
bool starts_with_numbers(const char* at, const char* end, int wanted) {
  while (wanted > 0) {
    while (at != end && kinds[static_cast<unsigned char>(*at)] == Kind::blank) ++at;
    bool digits = false;
    for (; at != end; ++at) {
      const Kind kind = kinds[static_cast<unsigned char>(*at)];
      if (kind == Kind::blank) break;
      if (kind == Kind::word) return false;
      digits = digits || kind == Kind::digit;
    }
    if (!digits) return false;
    --wanted;
  }
  return true;
}

struct Counts {
  std::int64_t positions = 0, uvs = 0, normals = 0;

  void add(std::string_view key) {
    positions += key == "v";
    uvs += key == "vt";
    normals += key == "vn";
  }
};

/// Checks one index, "7" or "-1", against how many there are in the whole file and up to its line.
void check_index(std::string_view digits, std::int64_t all, std::int64_t so_far, const char* what,
                 const std::string& where, std::string_view line) {
  std::int64_t index = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  const bool is_number = problem == std::errc{} && end == digits.data() + digits.size();
  if (!is_number || index == 0 || index > all || index < -so_far)
    throw Error(
        fmt::format("{}: \"{}\" names {} {}; there are {}, counted from 1, or from -1 backwards",
                    where, shown(line), what, shown(digits), all));
}

void check_face(std::string_view words, const Counts& all, const Counts& so_far,
                const std::string& where, std::string_view line) {
  for (std::string_view word; !(word = next_word(words)).empty();) {
    const std::size_t slash = word.find('/');
    check_index(word.substr(0, slash), all.positions, so_far.positions, "vertex", where, line);
    if (slash == word.npos) continue;
    word.remove_prefix(slash + 1);
    const std::size_t second = word.find('/');
    if (const auto uv = word.substr(0, second); !uv.empty())
      check_index(uv, all.uvs, so_far.uvs, "texture coordinate", where, line);
    if (second == word.npos) continue;
    check_index(word.substr(second + 1), all.normals, so_far.normals, "normal", where, line);
  }
}

void check_finite(std::string_view words, const std::string& where, std::string_view line) {
  for (int i = 0; i < 3; ++i) {
    const std::string word(next_word(words));
    if (!std::isfinite(std::strtof(word.c_str(), nullptr)))
      throw Error(fmt::format(
          "{}: \"{}\" has a coordinate beyond the range of a float; positions below 3e38", where,
          shown(line)));
  }
}

/// The end of the line that starts here, or of the text.
std::size_t line_end(const std::string& text, std::size_t begin) {
  return std::min(text.find('\n', begin), text.size());
}

/// Where the backslash stands after which a line goes on in the next; npos if it does not.
std::size_t mark_of_going_on(const std::string& text, std::size_t begin, std::size_t end) {
  if (end > begin && text[end - 1] == '\r') --end;
  return end > begin && end < text.size() && text[end - 1] == '\\' ? end - 1 : text.npos;
}

/// Joins a line and those in which it goes on. The end of all of them.
std::size_t join_lines(std::string& text, std::size_t begin, std::size_t end) {
  std::string joined;
  std::size_t newlines = 0, from = begin;
  for (std::size_t mark; (mark = mark_of_going_on(text, from, end)) != text.npos; ++newlines) {
    joined.append(text, from, mark - from);
    joined.append(end - mark, ' ');  // backslash, and \r if there is one
    from = end + 1;
    end = line_end(text, from);
  }
  joined.append(text, from, end - from);
  joined.append(newlines, '\n');
  text.replace(begin, joined.size(), joined);
  return end;
}

/// Of a file's name, the backslashes of Windows become slashes; one before a blank only keeps it.
void join_name(std::string& text, std::size_t begin, bool is_file) {
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  const std::size_t end = end_of_name(text, begin);
  for (std::size_t i = begin; i < end; ++i)
    if (is_blank(text[i]))
      text[i] = joint;
    else if (is_file && text[i] == '\\' && !(i + 1 < end && is_blank(text[i + 1])))
      text[i] = '/';
}

}  // namespace

void prepare_obj(std::string& text) {
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = line_end(text, begin);
    while (begin < end && is_blank(text[begin])) ++begin;
    const std::string_view line(text.data() + begin, end - begin);
    if (line.starts_with('v') || line.starts_with('f')) {
      if (mark_of_going_on(text, begin, end) != text.npos) end = join_lines(text, begin, end);
    } else if (line.size() > 6 && is_blank(line[6]) &&
               (line.starts_with("usemtl") || line.starts_with("mtllib"))) {
      join_name(text, begin + 6, line.starts_with("mtllib"));
    }
  }
}

void check_obj_numbers(std::string_view text, const std::string& file) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto check = [&](const char* line, const char* line_end) {
    while (line != line_end && is_blank(*line)) ++line;
    if (line_end - line < 2 || line[0] != 'v') return;
    const bool position = is_blank(line[1]);
    const bool named = line_end - line > 2 && is_blank(line[2]);
    const bool normal = named && line[1] == 'n';
    const bool uv = named && line[1] == 't';
    if (!position && !normal && !uv) return;
    const int wanted = uv ? 1 : 3;
    if (starts_with_numbers(line + 2, line_end, wanted)) return;
    const auto number = 1 + std::count(text.data(), line, '\n');
    throw Error(fmt::format("{}:{}: \"{}\" lacks numbers; {} finite numbers", file, number,
                            shown({line, std::size_t(line_end - line)}),
                            wanted == 3 ? "three" : "one to three"));
  };
  while (at != end) {
    const auto* stop = static_cast<const char*>(std::memchr(at, '\n', std::size_t(end - at)));
    if (stop == nullptr) stop = end;
    check(at, stop);
    at = stop == end ? end : stop + 1;
  }
}

void explain_broken_obj(std::string_view text, const std::string& file) {
  Counts all, so_far;
  for_each_line(text, [&](auto key, auto...) { all.add(key); });
  for_each_line(text, [&](auto key, auto words, auto line, std::int64_t number) {
    so_far.add(key);
    if (key != "f" && key != "v") return;
    const std::string where = fmt::format("{}:{}", file, number);
    if (key == "f")
      check_face(words, all, so_far, where, line);
    else
      check_finite(words, where, line);
  });
}

std::string remark_on_thin_faces(std::string_view text, const std::string& file) {
  std::string first;
  int count = 0;
  for_each_line(text, [&](auto key, auto words, auto line, std::int64_t number) {
    if (key != "f") return;
    int corners = 0;
    while (!next_word(words).empty()) ++corners;
    if (corners < 3 && count++ == 0)
      first = fmt::format("{}:{}: \"{}\" has less than three vertices and is left out", file,
                          number, shown(line));
  });
  return count > 1 ? fmt::format("{} ({} such faces in all)", first, count) : first;
}

}  // namespace airlight
