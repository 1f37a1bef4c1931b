// Files that cannot serve: the program says so in one line, ends with status 2, writes nothing and
// leaves what is there as it was.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <map>

#include "support/program.h"

namespace airlight::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* head = R"([image]
width = 32
height = 24
[render]
spp = 4
first_sample = 0
)";

constexpr const char* fog = R"([[media]]
sigma_s = 0.3
sigma_a = 0.1
shape = {type = "box", min = [-1, -1, -1], max = [1, 1, 1]}
)";

constexpr const char* sun = R"([[lights]]
type = "directional"
irradiance = 3
direction = [-1, -2, -0.5]
group = "sun"
)";

/// A tetrahedron, moved and with as many of its sides.
std::string tetrahedron(double z, int first, int sides) {
  std::string text;
  for (const std::array<double, 3>& p :
       {std::array{-1., -1., z - 1}, {1., -1., z - 1}, {0., 1., z - 1}, {0., 0., z + 1}})
    text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  const std::array<int, 3> corners[] = {{1, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}};
  for (int i = 0; i < sides; ++i) {
    text += "f";
    for (const int corner : corners[i]) text += fmt::format(" {}", first + corner);
    text += "\n";
  }
  return text;
}

struct Desk {
  Folder folder;

  std::string operator/(const std::string& name) const { return folder / name; }

  void write(const std::string& name, const std::string& text) const {
    write_bytes(folder / name, text);
  }

  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> content;
    for (const std::string& name : folder.names()) content[name] = bytes_of(folder / name);
    return content;
  }

  /// The one line that is said.
  std::string refusal(std::vector<std::string> words) const {
    const auto before = content();
    words.insert(words.end(), {"-o", folder / "out.exr", "-o", folder / "out.png"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(content() == before) << outcome.err;
    std::string text = outcome.err;
    const std::string here = folder / "";
    for (std::size_t i; (i = text.find(here)) != std::string::npos;) text.erase(i, here.size());
    return text;
  }

  std::string refusal_of_scene(const std::string& text) const {
    write("scene.toml", text);
    return refusal({"render", folder / "scene.toml"});
  }

  void render(const std::string& checkpoint, std::vector<std::string> flags) const {
    write("scene.toml", std::string(head) + fog + sun);
    flags.insert(flags.begin(), {"render", folder / "scene.toml", "-o", folder / "picture.exr",
                                 "--checkpoint", folder / checkpoint});
    ASSERT_EQ(run(flags).status, 0);
  }
};

TEST(BadFiles, of_a_medium_are_told_apart) {
  const Desk desk;
  const auto shaped_by = [](const std::string& file) {
    return std::string(head) + sun + "[[media]]\nalbedo = 0.5\nsigma_t = 1\n" +
           "shape = {type = \"mesh\", file = \"" + file + "\"}\n";
  };
  desk.write("open.obj", tetrahedron(0, 0, 3));
  EXPECT_THAT(
      desk.refusal_of_scene(shaped_by("open.obj")),
      testing::StartsWith("scene.toml:15:32: media.0.shape.file = \"open.obj\" is no closed "
                          "body: its edge from"));
  desk.write("crossing.obj", tetrahedron(0, 0, 4) + tetrahedron(0.5, 4, 4));
  EXPECT_THAT(desk.refusal_of_scene(shaped_by("crossing.obj")),
              testing::StartsWith("scene.toml:15:32: media.0.shape.file = \"crossing.obj\" crosses "
                                  "itself: its triangles"));
  EXPECT_EQ(desk.refusal_of_scene(shaped_by("none.obj")),
            "scene.toml:15:32: media.0.shape.file names a model that is not to be had: none.obj: "
            "cannot be read: No such file or directory\n");
  EXPECT_EQ(
      desk.refusal_of_scene(std::string(head) + fog + sun + fog),
      "scene.toml:7:1: media hold two that overlap, media.0 and media.1; accepted: media that "
      "touch at most\n");
}

TEST(BadFiles, of_a_gobo_are_told_apart) {
  const Desk desk;
  const std::string scene =
      std::string(head) + fog +
      "[[lights]]\ntype = \"collimated\"\nposition = [0, 3, 0]\n"
      "direction = [0, -1, 0]\nirradiance = 1\n"
      "cross_section = {type = \"circle\", radius = 1}\nimage = \"gobo.png\"\n";
  const std::string where =
      "scene.toml:17:9: lights.0.image names a picture that is not to be had: ";
  EXPECT_EQ(desk.refusal_of_scene(scene),
            where + "gobo.png: cannot be read: No such file or directory\n");
  desk.write("gobo.png", "no picture");
  EXPECT_THAT(desk.refusal_of_scene(scene), testing::StartsWith(where + "gobo.png: "));
}

TEST(BadFiles, to_go_on_with_stay_as_they_are) {
  const Desk desk;
  desk.render("a.ckpt", {});
  const auto resume = [&](const std::string& checkpoint, std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"render", desk / "scene.toml", "--checkpoint", desk / checkpoint});
    return desk.refusal(flags);
  };
  EXPECT_EQ(resume("a.ckpt", {"--resume", "-D", "media.0.sigma_s=0.5"}),
            "a.ckpt: is of another render: not the same media\n");
  EXPECT_EQ(resume("a.ckpt", {"--resume", "--size", "16x12"}),
            "a.ckpt: is of another render: image is 32 x 24, not 16 x 12\n");
  EXPECT_EQ(resume("a.ckpt", {}),
            "a.ckpt: is there already; accepted: a new file, or --resume to go on with it\n");
  const std::string bytes = bytes_of(desk / "a.ckpt");
  desk.write("cut.ckpt", bytes.substr(0, 10'000));  // behind the header
  EXPECT_THAT(
      resume("cut.ckpt", {"--resume"}),
      EndsWith("cut.ckpt: is cut short: 10000 of " + std::to_string(bytes.size()) + " bytes\n"));
  desk.write("text.ckpt", "a text");
  EXPECT_EQ(resume("text.ckpt", {"--resume"}), "text.ckpt: is no checkpoint of Airlight\n");
  EXPECT_THAT(resume("a.####.ckpt", {}),
              HasSubstr("a.####.ckpt: # stands for the number of a frame, which --frames gives\n"));
}

TEST(BadFiles, are_not_merged) {
  const Desk desk;
  desk.render("a.ckpt", {});
  desk.render("late.ckpt", {"--first-sample", "2"});
  desk.render("small.ckpt", {"--first-sample", "4", "--size", "16x12"});
  const auto merge = [&](const std::string& other) {
    return desk.refusal({"merge", desk / "a.ckpt", desk / other, "-o", desk / "sum.ckpt"});
  };
  const std::string refused = " cannot be added to a.ckpt: ";
  EXPECT_EQ(merge("late.ckpt"),
            "late.ckpt:" + refused +
                "samples 2 to 3 of seed 0 are there twice; accepted: ranges that do not overlap\n");
  EXPECT_EQ(merge("small.ckpt"),
            "small.ckpt:" + refused +
                "is of another render: image is 16 x 12, not 32 x 24; accepted: the same scene and "
                "settings\n");
  EXPECT_EQ(merge("none.ckpt"), "none.ckpt: cannot be read: No such file or directory\n");
  desk.write("cut.ckpt", bytes_of(desk / "a.ckpt").substr(0, 50));
  EXPECT_THAT(merge("cut.ckpt"), HasSubstr("cut.ckpt: is cut short"));
}

TEST(BadFiles, have_no_group_of_lights_to_mix) {
  const Desk desk;
  desk.render("a.ckpt", {});
  EXPECT_EQ(desk.refusal({"mix", desk / "picture.exr", "--gain", "lamp=2"}),
            "picture.exr: has no light group lamp; it has: sun, ungrouped\n");
}

TEST(BadFiles, of_depths_fit_the_picture) {
  const Desk desk;
  desk.write("depths.pfm", "Pf\n4 1\n-1\n" + std::string(16, '\x3f'));
  EXPECT_EQ(
      desk.refusal_of_scene(std::string(head) +
                            "[[objects]]\ntype = \"depth_image\"\nfile = \"depths.pfm\"\n"),
      "scene.toml:9:8: objects.0.file names a depth image of other proportions: depths.pfm is "
      "4 x 1 pixels; accepted: 32 x 24, the picture's, a size of the same proportions, or a "
      "camera of its own\n");
}

}  // namespace
}  // namespace airlight::test
