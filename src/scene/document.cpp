#include "scene/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "error.h"
#include "image/read_file.h"

namespace airlight {
namespace {

using Source = std::shared_ptr<const std::string>;

Place place_of(const toml::source_region& region, const Source& source) {
  return {source, int(region.begin.line), int(region.begin.column)};
}

Value value_of(const toml::node& node, const Source& source);

Value::Table table_of(const toml::table& table, const Source& source) {
  Value::Table result;
  for (const auto& [key, node] : table) {
    Value value = value_of(node, source);
    value.key_place = place_of(key.source(), source);
    result.emplace(std::string(key.str()), std::move(value));
  }
  return result;
}

Value::Array array_of(const toml::array& array, const Source& source) {
  Value::Array result;
  for (const toml::node& node : array) result.push_back(value_of(node, source));
  return result;
}

Value value_of(const toml::node& node, const Source& source) {
  Value value;
  value.place = place_of(node.source(), source);
  node.visit([&](const auto& n) {
    if constexpr (toml::is_table<decltype(n)>)
      value.data = table_of(n, source);
    else if constexpr (toml::is_array<decltype(n)>)
      value.data = array_of(n, source);
    else if constexpr (toml::is_string<decltype(n)>)
      value.data = n.get();
    else if constexpr (toml::is_number<decltype(n)> || toml::is_boolean<decltype(n)>)
      value.data = n.get();
    else {
      std::ostringstream text;
      text << n.get();
      value.data = Value::Date{text.str()};
    }
  });
  return value;
}

/// The parser's complaint in one line, in the tone of the house.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  constexpr std::string_view prefix = "Error while parsing ";
  if (text.starts_with(prefix)) text = "bad TOML in " + text.substr(prefix.size());
  return text;
}

bool is_index(const std::string& part) {
  return !part.empty() && part.size() < 10 &&
         std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c); });
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The new value of an override; whatever is not TOML and does not look as if it tried to be is a
/// bare word.
Value parse_value(const Override& change, const Source& source) {
  const auto word = [&] { return Value{change.value, {source}, {source}}; };
  if (change.value.empty())
    throw Error(change.said +
                ": the value is missing; accepted: one as a scene file says it, such as 3, "
                "[1, 2, 3] or rewv, and \"\" for an empty text");
  if (change.value.find('\n') != std::string::npos) return word();
  try {
    const toml::table table = toml::parse("v = " + change.value);
    Value value = value_of(*table.get("v"), Source());
    const auto settle = [&](auto&& self, Value& v) -> void {
      v.place = v.key_place = {source};
      if (auto* t = std::get_if<Value::Table>(&v.data))
        for (auto& [key, child] : *t) self(self, child);
      if (auto* a = std::get_if<Value::Array>(&v.data))
        for (Value& child : *a) self(self, child);
    };
    settle(settle, value);
    return value;
  } catch (const toml::parse_error& error) {
    constexpr std::string_view openers = "[{\"'";
    if (openers.find(change.value[0]) != std::string_view::npos)
      throw Error(fmt::format("{}: the value is not TOML: {}", change.said,
                              one_line(std::string(error.description()))));
    double number = 0;  // such as ".5", which TOML wants as "0.5"
    const char* end = change.value.data() + change.value.size();
    const auto [stop, failed] = std::from_chars(change.value.data(), end, number);
    if (stop == end && failed == std::errc::result_out_of_range)
      throw Error(fmt::format("{}: the number is too large or too small to be held", change.said));
    if (stop == end && failed == std::errc()) {
      Value value = word();
      value.data = number;
      return value;
    }
    return word();
  }
}

}  // namespace

std::string Place::text() const {
  if (!source) return "";
  return line > 0 ? fmt::format("{}:{}:{}", *source, line, column) : *source;
}

const Place* Value::overridden() const {
  if (place.is_override()) return &place;
  const auto first_of = [](const auto& parts, auto&& value_of_part) -> const Place* {
    for (const auto& part : parts)
      if (const Place* found = value_of_part(part).overridden()) return found;
    return nullptr;
  };
  if (table())
    return first_of(
        *table(), [](const auto& entry) -> auto& { return entry.second; });
  if (array())
    return first_of(
        *array(), [](const Value& value) -> auto& { return value; });
  return nullptr;
}

std::string Value::text() const {
  const auto join = [](const auto& items, auto&& show) {
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "" : ", ") + show(item);
    return text;
  };
  struct Show {
    decltype(join)& join_items;
    std::string operator()(const Table& table) const {
      return fmt::format("{{{}}}", join_items(table, [](const auto& entry) {
                           return entry.first + " = " + entry.second.text();
                         }));
    }
    std::string operator()(const Array& array) const {
      return fmt::format("[{}]", join_items(array, [](const Value& v) { return v.text(); }));
    }
    std::string operator()(const std::string& s) const { return fmt::format("\"{}\"", s); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(std::int64_t x) const { return fmt::format("{}", x); }
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(const Date& date) const { return date.text; }
  };
  std::string text = one_line(std::visit(Show{join}, data));
  constexpr std::size_t most = 60;
  if (text.size() > most) text = text.substr(0, most - 3) + "...";
  return text;
}

Override::Override(const std::string& assignment) : said(fmt::format("-D {}", assignment)) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(said + ": a change is path=value, as in lights.0.irradiance=3");
  const auto trim = [](std::string s) {
    const auto space = [](unsigned char c) { return std::isspace(c) != 0; };
    while (!s.empty() && space(s.back())) s.pop_back();
    s.erase(s.begin(), std::ranges::find_if_not(s, space));
    return s;
  };
  path = trim(assignment.substr(0, equals));
  value = trim(assignment.substr(equals + 1));
}

Override::Override(std::string path_, std::string value_, std::string said_)
    : path(std::move(path_)), value(std::move(value_)), said(std::move(said_)) {}

Value parse_document(const std::string& text, const std::string& name) {
  const auto source = std::make_shared<const std::string>(name);
  try {
    Value root{table_of(toml::parse(text), source), {source, 1, 1}, {source, 1, 1}};
    return root;
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}: {}", place_of(error.source(), source).text(),
                            one_line(std::string(error.description()))));
  }
}

Value read_document(const std::filesystem::path& path) {
  return parse_document(read_text(path), path.string());
}

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04x}", int(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

bool is_within(const std::string& path, const std::string& whole) {
  return path == whole || path.starts_with(whole + ".");
}

void replace(const std::string& path, Value value, Value& document) {
  const std::string said = value.key_place.text();
  Value* at = &document;
  bool is_new = false;
  std::string so_far;
  for (const std::string& part : split(path)) {
    const std::string here = so_far.empty() ? "the scene" : so_far;
    so_far += (so_far.empty() ? "" : ".") + part;
    if (part.empty()) throw Error(said + ": a key is empty in the path");
    if (is_new && is_index(part)) at->is_sparse = true;
    if (auto* array = std::get_if<Value::Array>(&at->data)) {
      if (!is_index(part) || std::stoul(part) >= array->size())
        throw Error(fmt::format("{}: {} is not there; {} is a list of {}, counted from 0", said,
                                so_far, here, array->size()));
      at = &(*array)[std::stoul(part)];
    } else if (auto* table = std::get_if<Value::Table>(&at->data)) {
      const auto [entry, made] = table->try_emplace(part);
      at = &entry->second;
      is_new = made;
      if (is_new) at->place = at->key_place = value.key_place;
    } else {
      throw Error(
          fmt::format("{}: {} is not there; {} = {} has no parts", said, so_far, here, at->text()));
    }
  }
  *at = std::move(value);
}

void apply(const Override& change, Value& document) {
  const auto source = std::make_shared<const std::string>(change.said);
  replace(change.path, parse_value(change, source), document);
}

}  // namespace airlight
