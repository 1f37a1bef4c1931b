// Reads every #include of the project and holds it to the directions of dependence.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// Which other rooms of the repository a room may include. `src` stands for the files directly in
/// src/.
const std::map<std::string, Names> may_include = {
    {"include/airlight", {}},
    {"src", {}},
    {"src/image", {"src"}},
    {"src/report", {"src", "src/image"}},
    {"src/scene", {"src", "src/image", "include/airlight"}},
    {"src/geometry", {"src", "src/image", "src/scene", "include/airlight"}},
    {"src/render", {"src", "src/image", "src/scene", "src/geometry", "include/airlight"}},
    {"src/study",
     {"src", "src/image", "src/report", "src/scene", "src/geometry", "src/render",
      "include/airlight"}},
    {"apps",
     {"src", "src/image", "src/report", "src/scene", "src/geometry", "src/render", "src/study",
      "include/airlight"}},
};

/// Their members do not include each other, except those that are made of their siblings.
const Names families = {"phases", "shapes", "lights", "placements", "forms", "estimators"};
const Names made_of_siblings = {"include/airlight/placements/mixed.h"};

/// The one file that may see the SIMD library.
const std::string simd = "include/airlight/math/simd.h";

struct Include {
  std::string from;  ///< path from the root of the repository
  std::string text;  ///< what stands between the quotes or brackets
  std::string to;    ///< path from the root, or empty for a header from outside
};

fs::path root() { return AIRLIGHT_SOURCE_DIR; }

/// "src/scene" of "src/scene/scene.h", "src" of "src/error.h"; "" outside of the rooms that have
/// rules.
std::string room_of(const std::string& path) {
  std::string room;
  for (const auto& [name, unused] : may_include)
    if (path.starts_with(name + "/"))
      room = std::max(room, name);  // the longer of src and src/scene
  if (room == "src" && std::ranges::count(path, '/') > 1) return path.substr(0, path.find('/', 4));
  return room;
}

std::string family_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().filename();
  return families.contains(folder) ? fs::path(path).parent_path().string() : "";
}

bool is_standard(const std::string& text) { return text.find_first_of("./") == std::string::npos; }

/// What is wrong with an include, or "".
std::string complaint(const Include& include) {
  const std::string from = room_of(include.from), to = room_of(include.to);
  if (include.text.starts_with("xsimd") && include.from != simd)
    return "only " + simd + " sees xsimd";
  if (include.to.empty()) {
    const bool allowed = from != "include/airlight" || is_standard(include.text) ||
                         include.text.starts_with("xsimd/");
    return allowed ? "" : "the core uses the standard library alone";
  }
  if (to == "apps" && from != "apps") return "nothing includes a program";
  if (from.empty() || from == to) {
    const std::string family = family_of(include.from);
    const bool siblings = !family.empty() && family == family_of(include.to);
    return siblings && !made_of_siblings.contains(include.from)
               ? "siblings do not include each other"
               : "";
  }
  if (!may_include.contains(from)) return from + " has no row in may_include";
  return may_include.at(from).contains(to) ? "" : from + " may not include " + to;
}

/// Where the compiler would find it: beside the file, in src/ or in include/.
std::string resolve(const fs::path& file, const std::string& text) {
  for (const fs::path& folder : {file.parent_path(), root() / "src", root() / "include"})
    if (fs::is_regular_file(folder / text))
      return fs::relative(fs::weakly_canonical(folder / text), fs::weakly_canonical(root()));
  return "";
}

std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<Include> found;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, pattern))
      found.push_back({fs::relative(file, root()), match[1], resolve(file, match[1])});
  return found;
}

std::vector<Include> every_include() {
  std::vector<Include> all;
  for (const char* folder : {"include", "src", "apps", "bench", "examples", "tests"}) {
    if (!fs::exists(root() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root() / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        std::ranges::copy(includes_of(entry.path()), std::back_inserter(all));
  }
  return all;
}

/// Every file of the repository that a file sees, through however many others.
void add_reached(const std::string& file, Names& reached) {
  if (!reached.insert(file).second) return;
  for (const Include& include : includes_of(root() / file))
    if (!include.to.empty()) add_reached(include.to, reached);
}

}  // namespace

TEST(Includes, follow_the_directions_of_the_house) {
  const std::vector<Include> all = every_include();
  EXPECT_GT(all.size(), 100u) << "too few to be the whole project";
  for (const Include& include : all)
    EXPECT_EQ(complaint(include), "") << include.from << " includes " << include.text;
}

TEST(Includes, of_the_scene_reach_no_estimator) {
  for (const auto& entry : fs::directory_iterator(root() / "src/scene")) {
    Names reached;
    add_reached(fs::relative(entry.path(), root()), reached);
    EXPECT_THAT(reached,
                ::testing::Each(::testing::Not(::testing::HasSubstr("airlight/estimator"))))
        << entry.path();
  }
}

TEST(Includes, against_the_directions_are_noticed) {
  const std::string core = "include/airlight/phase.h";
  const std::vector<Include> wrong = {
      {core, "error.h", "src/error.h"},
      {core, "fmt/format.h", ""},
      {core, "xsimd/xsimd.hpp", ""},
      {"src/render/kernel.cpp", "xsimd/xsimd.hpp", ""},
      {"src/scene/scene.h", "render/film.h", "src/render/film.h"},
      {"src/scene/scene.h", "geometry/world.h", "src/geometry/world.h"},
      {"src/image/png.cpp", "scene/scene.h", "src/scene/scene.h"},
      {"src/report/page.cpp", "scene/scene.h", "src/scene/scene.h"},
      {"src/geometry/world.h", "render/film.h", "src/render/film.h"},
      {"src/error.h", "image/image.h", "src/image/image.h"},
      {"src/attic/box.h", "image/image.h", "src/image/image.h"},
      {"tests/render.cpp", "../apps/airlight/verbs.h", "apps/airlight/verbs.h"},
      {"include/airlight/phases/rayleigh.h", "isotropic.h", "include/airlight/phases/isotropic.h"},
  };
  for (const Include& include : wrong)
    EXPECT_NE(complaint(include), "") << include.from << " includes " << include.text;
}

TEST(Includes, along_the_directions_are_welcome) {
  const std::vector<Include> right = {
      {simd, "xsimd/xsimd.hpp", ""},
      {simd, "cmath", ""},
      {"include/airlight/phases/rayleigh.h", "../describe.h", "include/airlight/describe.h"},
      {"include/airlight/phases.h", "phases/rayleigh.h", "include/airlight/phases/rayleigh.h"},
      {"src/image/png.cpp", "png.h", ""},
      {"src/image/png.cpp", "error.h", "src/error.h"},
      {"apps/airlight/main.cpp", "render/render.h", "src/render/render.h"},
      {"apps/airlight/main.cpp", "verbs.h", "apps/airlight/verbs.h"},
  };
  for (const Include& include : right)
    EXPECT_EQ(complaint(include), "") << include.from << " includes " << include.text;
}
