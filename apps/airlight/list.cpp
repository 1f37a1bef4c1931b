#include <airlight/estimators.h>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

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

}  // namespace

Action set_up_list(CLI::App& verb) {
  const auto markdown = std::make_shared<bool>(false);
  verb.footer("Examples:\n  airlight list\n  airlight list --markdown\n");
  verb.add_flag("--markdown", *markdown, "as a page: what docs/scene-reference.md holds");
  return [markdown] {
    const std::vector<Chapter> chapters = reference();
    const std::string text =
        *markdown ? fmt::format("# Scene reference\n\nWritten by `airlight list --markdown`.\n\n{}",
                                as_markdown(chapters))
                  : as_text(chapters);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
  };
}
