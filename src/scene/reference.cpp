#include "scene/reference.h"

#include <algorithm>
#include <concepts>

#include "scene/scene_document.h"

namespace airlight {
namespace {

template <Described T>
MemberEntry table(const char* name, const char* meaning) {
  return {name, meaning, parameters_of<T>()};
}

/// Breaks a text between words; all lines but the first are indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 100;
  std::string result, line;
  const auto flush = [&] {
    result += (result.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
    line.clear();
  };
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) flush();
    line += (line.empty() ? "" : " ") + word;
    start = end + 1;
  }
  flush();
  return result;
}

/// A vertical bar would end the cell of a table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// The kinds of objects that say themselves what they look like.
std::string unsurfaced_objects() {
  std::vector<std::string> names;
  for_each_member<Objects>([&]<class Kind>(const Kind&) {
    if constexpr (!std::derived_from<Kind, SurfacedObject>) names.push_back(Kind::name);
  });
  return accepted_words(std::move(names));
}

}  // namespace

std::vector<Chapter> scene_reference() {
  return {
      {"Scene file",
       "TOML, in SI units; up is +y. A key that is not listed is an error. Every value can be "
       "changed from the command line by its path: -D lights.0.irradiance=3. Files that such a "
       "change names start at the current folder.",
       {table<SceneDocument>("top level", "what stands before the first table, and the tables"),
        table<Camera>("[camera]", "a pinhole camera, anywhere: outside, on or inside the medium"),
        table<Resolution>("[image]", "the size of the picture"),
        table<RenderSettings>("[render]",
                              "how the picture is made; each key is a flag, too: --spp"),
        table<MediumDocument>("[[media]]",
                              "a homogeneous medium: sigma_s and sigma_a, or albedo and sigma_t, "
                              "or albedo and visibility"),
        table<AnimationDocument>("[[animation]]",
                                 "a value that changes from frame to frame, by its path")}},
      {"Lights", "[[lights]], told apart by type. All take the keys of light.",
       members_of<LightDocuments>()},
      {"Keys of lights",
       "What lights have in common.",
       {table<GroupedLight>("light", "every kind of light")}},
      {"Cross-sections", "cross_section of a collimated light, told apart by type.",
       members_of<CrossSectionDocuments>()},
      {"Phase functions", "phase of a medium, told apart by type.", members_of<Phases>()},
      {"Shapes", "shape of a medium, told apart by type.", members_of<ShapeDocuments>()},
      {"Objects",
       fmt::format(
           "[[objects]], told apart by type. All take the keys of place; all but those with "
           "colours of their own ({}) take the keys of surface.",
           unsurfaced_objects()),
       members_of<Objects>()},
      {"Keys of objects",
       "What objects have in common.",
       {table<PlacedObject>("place", "where an object is put: scaled, then turned, then moved"),
        table<SurfacedObject>("surface", "how it reflects and filters light; both sides alike")}},
  };
}

std::string as_text(const std::vector<Chapter>& chapters) {
  std::string text;
  for (const Chapter& chapter : chapters) {
    text += fmt::format("{}{}\n{}\n", text.empty() ? "" : "\n", chapter.title,
                        wrapped(chapter.text, 0));
    for (const MemberEntry& member : chapter.members) {
      text += fmt::format("\n  {:<18} {}\n", member.name, wrapped(member.meaning, 21));
      for (const ParameterEntry& p : member.parameters)
        text += fmt::format(
            "    {:<16} {}\n", p.key,
            wrapped(fmt::format("{}; {}; default {}", p.meaning, p.accepted, p.default_value), 21));
    }
  }
  return text;
}

std::string as_markdown(const std::vector<Chapter>& chapters) {
  std::string text;
  for (const Chapter& chapter : chapters) {
    text += fmt::format("{}## {}\n\n{}\n", text.empty() ? "" : "\n", chapter.title, chapter.text);
    for (const MemberEntry& member : chapter.members) {
      text += fmt::format("\n### `{}`\n\n{}.\n", member.name, member.meaning);
      if (member.parameters.empty()) continue;
      text += "\n| key | takes | default | meaning |\n|---|---|---|---|\n";
      for (const ParameterEntry& p : member.parameters)
        text += fmt::format("| `{}` | {} | {} | {} |\n", p.key, cell(p.accepted),
                            cell(p.default_value), cell(p.meaning));
    }
  }
  return text;
}

}  // namespace airlight
