// Every member of every family stands in its list, in a file of its own, in `airlight list` and in
// docs/scene-reference.md.

#include <airlight/estimators.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "support/program.h"

namespace airlight::test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using ::testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

fs::path core() { return fs::path(AIRLIGHT_SOURCE_DIR) / "include/airlight"; }

/// What a pattern's first group holds, at every place where the text has it.
std::vector<std::string> found(const std::string& text, const char* pattern) {
  const std::regex regex(pattern, std::regex::multiline);
  std::vector<std::string> all;
  for (auto i = std::sregex_iterator(text.begin(), text.end(), regex); i != std::sregex_iterator();
       ++i)
    all.push_back((*i)[1]);
  return all;
}

/// A folder of the core and its list.
template <class List>
struct Family {
  const char* folder;
};

template <class... Members>
Names names_in(const std::variant<Members...>*) {
  return {Members::name...};
}
template <class List>
const Names names = names_in(static_cast<const List*>(nullptr));

/// Calls check with every family.
template <class Check>
void for_each_family(Check&& check) {
  const auto one = [&]<class List>(Family<List> family) {
    SCOPED_TRACE(family.folder);
    check(std::string(family.folder), names<List>);
  };
  one(Family<Phases>{"phases"});
  one(Family<Shapes>{"shapes"});
  one(Family<Lights>{"lights"});
  one(Family<Placements>{"placements"});
  one(Family<Forms>{"forms"});
  one(Family<Estimators>{"estimators"});
}

/// The families' folders, found as the core's folders with a list beside them.
Names folders_with_a_list() {
  Names folders;
  for (const auto& entry : fs::directory_iterator(core()))
    if (entry.is_directory() && fs::exists(entry.path().string() + ".h"))
      folders.insert(entry.path().filename());
  return folders;
}

TEST(Families, are_all_of_the_core) {
  Names walked;
  for_each_family([&](const std::string& folder, const Names&) { walked.insert(folder); });
  EXPECT_EQ(walked, folders_with_a_list());
}

TEST(Families, have_one_file_a_member_and_no_other) {
  for_each_family([](const std::string& folder, const Names& listed) {
    Names in_files;
    const std::string list = text_of(core() / (folder + ".h"));
    for (const auto& entry : fs::directory_iterator(core() / folder)) {
      const std::string file = entry.path().filename();
      SCOPED_TRACE(file);
      const auto names = found(text_of(entry.path()), "static constexpr auto name = \"([^\"]+)\";");
      ASSERT_EQ(names.size(), 1u) << "a file of a family has one member";
      EXPECT_TRUE(in_files.insert(names.front()).second) << "another file has this name";
      EXPECT_TRUE(listed.contains(names.front()))
          << names.front() << " is not in " << folder << ".h";
      EXPECT_THAT(list, HasSubstr("#include \"" + folder + "/" + file + "\""));
    }
    EXPECT_EQ(in_files, listed);
  });
}

TEST(Families, say_what_they_mean_and_how_to_add_to_them) {
  for_each_family([](const std::string& folder, const Names&) {
    EXPECT_THAT(text_of(core() / (folder + ".h")),
                HasSubstr("To add one: its file in " + folder + "/"));
  });
}

/// `sampled` stands in `list` by its short names: it is any placement with any form.
Names names_to_look_for(const Names& listed) {
  Names looked_for = listed;
  if (looked_for.erase(Sampled::name))
    for (const ShortName& s : short_names) looked_for.insert(s.name);
  return looked_for;
}

TEST(Families, stand_in_airlight_list) {
  const Outcome outcome = run({"list"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto words = found(outcome.out, "^ *([a-z0-9_-]+)(?:[^a-z0-9_-]|$)");
  const Names first_words(words.begin(), words.end());
  for_each_family([&](const std::string&, const Names& listed) {
    for (const std::string& name : names_to_look_for(listed))
      EXPECT_TRUE(first_words.contains(name)) << name;
  });
}

TEST(Families, stand_in_the_scene_reference) {
  const auto headings =
      found(text_of(fs::path(AIRLIGHT_SOURCE_DIR) / "docs/scene-reference.md"), "^### `([^`]+)`$");
  const Names titles(headings.begin(), headings.end());
  for_each_family([&](const std::string&, const Names& listed) {
    for (const std::string& name : names_to_look_for(listed))
      EXPECT_TRUE(titles.contains(name)) << name;
  });
}

/// "henyey_greenstein.h" holds HenyeyGreenstein.
std::string type_in(const fs::path& file) {
  std::string type;
  bool starts_word = true;
  for (const char c : file.stem().string()) {
    if (c != '_') type += starts_word ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    starts_word = c == '_';
  }
  return type;
}

TEST(Families, stand_in_a_test) {
  std::string tests;
  for (const auto& entry : fs::directory_iterator(fs::path(AIRLIGHT_SOURCE_DIR) / "tests"))
    if (entry.path().extension() == ".cpp" && entry.path().filename() != "families.cpp")
      tests += text_of(entry.path());
  const Names walked = {"phases", "placements", "forms"};
  for (const char* list : {"MembersOf<Phases>", "MembersOf<Placements>", "MembersOf<Forms>"})
    EXPECT_THAT(tests, HasSubstr(list)) << "a newcomer is tested by being on its list";

  for_each_family([&](const std::string& folder, const Names&) {
    for (const auto& entry : fs::directory_iterator(core() / folder)) {
      const std::string type = type_in(entry.path());
      EXPECT_THAT(text_of(entry.path()), HasSubstr("struct " + type + " {"));
      if (walked.contains(folder)) continue;
      EXPECT_TRUE(std::regex_search(tests, std::regex("\\b" + type + "\\b"))) << type;
    }
  });
}

}  // namespace
}  // namespace airlight::test
