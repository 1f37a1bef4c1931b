#include <airlight/estimators.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

#include "error.h"
#include "scene/accepted.h"
#include "scene/reference.h"
#include "verbs.h"

namespace {

using namespace airlight;

/// The families that estimators are made of; they stand in [render], not in tables of their own.
std::vector<Chapter> estimator_chapters() {
  Chapter names{"Estimators",
                "render.estimator: one of these names, or placement+form. The default is rewv.",
                {}};
  for (const ShortName& s : short_names)
    names.members.push_back({s.name, fmt::format("{}+{}", s.placement, s.form), {}});
  for (MemberEntry& member : members_of<Estimators>())
    if (member.name != Sampled::name) names.members.push_back(std::move(member));
  return {names,
          {"Placements", "Where samples go along a camera ray.", members_of<Placements>()},
          {"Forms", "How samples become radiance.", members_of<Forms>()}};
}

std::vector<Chapter> reference() {
  std::vector<Chapter> chapters = scene_reference();
  for (Chapter& chapter : estimator_chapters()) chapters.push_back(std::move(chapter));
  return chapters;
}

/// "keys-of-lights" of "Keys of lights".
std::string name_of(const Chapter& chapter) {
  std::string name = chapter.title;
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return c == ' ' ? '-' : char(std::tolower(c)); });
  return name;
}

/// The chapter of a name, or all if there is none. Throws Error for a name that is not known.
std::vector<Chapter> chapters_named(const std::string& name) {
  std::vector<Chapter> chapters = reference();
  if (name.empty()) return chapters;
  std::vector<std::string> names;
  for (const Chapter& chapter : chapters) names.push_back(name_of(chapter));
  std::erase_if(chapters, [&](const Chapter& chapter) { return name_of(chapter) != name; });
  if (chapters.empty())
    throw Error(fmt::format("list: {} is not known here; accepted: {}", name,
                            accepted_words(std::move(names))));
  return chapters;
}

struct Flags {
  std::string chapter;
  bool markdown = false;
};

}  // namespace

Action set_up_list(CLI::App& verb) {
  const auto flags = std::make_shared<Flags>();
  verb.footer("Examples:\n  airlight list\n  airlight list lights\n  airlight list --markdown\n");
  verb.add_option("CHAPTER", flags->chapter, "one chapter alone, such as lights")->type_name("");
  verb.add_flag("--markdown", flags->markdown, "as a page: what docs/scene-reference.md holds");
  return [flags] {
    const std::vector<Chapter> chapters = chapters_named(flags->chapter);
    const std::string text =
        flags->markdown
            ? fmt::format("# Scene reference\n\nWritten by `airlight list --markdown`.\n\n{}",
                          as_markdown(chapters))
            : as_text(chapters);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  };
}
