// What `airlight list` tells and docs/scene-reference.md holds.

#include "scene/reference.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include "scene/scene_document.h"

namespace airlight {
namespace {

using ::testing::HasSubstr;

/// What the program prints.
std::string output_of(const std::string& arguments) {
  const std::string command = std::string(AIRLIGHT_PROGRAM) + " " + arguments;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe.get()))
    text.append(buffer.data(), n);
  return text;
}

const Chapter& chapter(const std::vector<Chapter>& chapters, const std::string& title) {
  return *std::ranges::find(chapters, title, &Chapter::title);
}

}  // namespace

TEST(Reference, page_is_fresh) {
  std::ifstream file(AIRLIGHT_SOURCE_DIR "/docs/scene-reference.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), output_of("list --markdown"))
      << "write it again: airlight list --markdown > docs/scene-reference.md";
}

TEST(Reference, tells_every_parameter_of_every_member) {
  const std::string text = output_of("list");
  for (const Chapter& chapter : scene_reference()) {
    EXPECT_THAT(text, HasSubstr(chapter.title));
    for (const MemberEntry& member : chapter.members) {
      EXPECT_THAT(text, HasSubstr("\n  " + member.name + " "));
      for (const ParameterEntry& parameter : member.parameters)
        EXPECT_THAT(text, HasSubstr("\n    " + parameter.key + " "));
    }
  }
  for (const char* name : {"rewv", "closed_form", "whole_volume", "equidistant", "difference"})
    EXPECT_THAT(text, HasSubstr(std::string("\n  ") + name + " "));
}

TEST(Reference, tells_ranges_units_and_defaults) {
  const auto chapters = scene_reference();
  const MemberEntry& light = chapter(chapters, "Lights").members.at(0);
  EXPECT_EQ(light.name, "directional");
  EXPECT_EQ(light.parameters.at(0).key, "irradiance");
  EXPECT_EQ(light.parameters.at(0).accepted, "a number or [r, g, b], each of at least 0 W/m2");
  EXPECT_EQ(light.parameters.at(0).default_value, "required");
  EXPECT_EQ(light.parameters.at(4).accepted, "a number in [0, 90) degrees");
  EXPECT_EQ(light.parameters.at(4).default_value, "0");
}

TEST(Reference, tells_shared_keys_once) {
  const auto chapters = scene_reference();
  for (const MemberEntry& object : chapter(chapters, "Objects").members)
    for (const ParameterEntry& parameter : object.parameters)
      EXPECT_NE(parameter.key, "translate") << object.name;
  EXPECT_EQ(chapter(chapters, "Keys of lights").members.at(0).parameters.at(0).key, "group");
  EXPECT_EQ(chapter(chapters, "Keys of objects").members.at(0).parameters.at(3).key, "translate");
}

TEST(Reference, gives_every_parameter_a_meaning) {
  for (const Chapter& chapter : scene_reference())
    for (const MemberEntry& member : chapter.members) {
      EXPECT_NE(member.meaning, "") << member.name;
      std::set<std::string> keys;
      for (const ParameterEntry& parameter : member.parameters) {
        EXPECT_NE(parameter.meaning, "") << member.name << "." << parameter.key;
        EXPECT_TRUE(keys.insert(parameter.key).second) << member.name << "." << parameter.key;
      }
    }
}

}  // namespace airlight
