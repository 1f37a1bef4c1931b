#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace airlight::test {

/// What is not well-formed in an XML text (elements, attributes, the five entities and numeric
/// ones; no comments or declarations), "" if all is well.
inline std::string xml_fault(std::string_view text) {
  std::vector<std::string> open;
  bool root_seen = false;
  const auto is_name = [](std::string_view name) {
    return !name.empty() && name.find_first_of(" <>&\"'=/\n") == name.npos;
  };
  const auto text_fault = [](std::string_view part) -> std::string {
    for (std::size_t i = part.find('&'); i != part.npos; i = part.find('&', i + 1)) {
      const std::string_view entity = part.substr(i, part.find(';', i) - i + 1);
      const std::set<std::string_view> known = {"&amp;",  "&lt;",   "&gt;",
                                                "&quot;", "&apos;", "&#39;"};
      if (!known.contains(entity)) return "stray & in \"" + std::string(part) + '"';
    }
    return part.find('<') == part.npos ? "" : "stray < in \"" + std::string(part) + '"';
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = text.find('<', at);
    const std::string_view between = text.substr(at, next - at);
    if (open.empty() && between.find_first_not_of(" \n\t") != between.npos)
      return "text outside the root";
    if (const std::string fault = text_fault(between); !fault.empty()) return fault;
    if (next == text.npos) break;
    const std::size_t end = text.find('>', next);
    if (end == text.npos) return "tag without an end";
    std::string_view tag = text.substr(next + 1, end - next - 1);
    at = end + 1;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return "wrong end tag " + std::string(tag);
      open.pop_back();
      continue;
    }
    if (open.empty() && root_seen) return "a second root " + std::string(tag);
    root_seen = true;
    const bool closed = tag.ends_with('/');
    if (closed) tag.remove_suffix(1);
    const std::string name(tag.substr(0, tag.find_first_of(" \n")));
    if (!is_name(name)) return "bad element <" + std::string(tag) + '>';
    tag.remove_prefix(name.size());
    std::set<std::string_view> attributes;
    while (tag.find_first_not_of(" \n") != tag.npos) {
      tag.remove_prefix(tag.find_first_not_of(" \n"));
      const std::size_t equals = tag.find("=\"");
      if (equals == tag.npos) return "attribute without a value in <" + name + ">";
      const std::string_view attribute = tag.substr(0, equals);
      const std::size_t quote = tag.find('"', equals + 2);
      if (!is_name(attribute) || quote == tag.npos) return "bad attribute in <" + name + '>';
      if (!attributes.insert(attribute).second) return "attribute twice in <" + name + '>';
      if (const auto fault = text_fault(tag.substr(equals + 2, quote - equals - 2)); !fault.empty())
        return fault;
      tag.remove_prefix(quote + 1);
    }
    if (!closed) open.push_back(name);
  }
  if (!open.empty()) return "<" + open.back() + "> is not closed";
  return root_seen ? "" : "no root";
}

}  // namespace airlight::test
