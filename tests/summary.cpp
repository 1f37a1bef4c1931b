#include "render/summary.h"

#include <gmock/gmock.h>

#include "render/render.h"
#include "scene/load_scene.h"

namespace airlight {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A room of fog 4 m long, seen along it, under an open sky.
constexpr const char* room = R"(
[camera]
position = [0, 0, 1.5]
target = [0, 0, -1]
[[media]]
sigma_s = 0.1
sigma_a = [0.1, 0.15, 0.3]
phase = {type = "henyey-greenstein", g = 0.25}
shape = {type = "box", min = [-1, -1, -2], max = [1, 1, 2]}
[[lights]]
type = "directional"
irradiance = 3
direction = [0, -1, 0]
[[objects]]
type = "box"
min = [-1, -1, -2]
max = [1, -0.9, 2]
)";

Summary summary_with(const std::vector<Override>& changes) {
  return summarise(parse_scene(room, "room", changes));
}

TEST(Summary, measures_the_fog) {
  const Summary s = summary_with({});
  ASSERT_EQ(s.media.size(), 1u);
  EXPECT_DOUBLE_EQ(s.media[0].across.value(), 4);
  EXPECT_DOUBLE_EQ(s.media[0].optical_depth.r, 0.8);
  EXPECT_DOUBLE_EQ(s.media[0].optical_depth.b, 1.6);
  EXPECT_DOUBLE_EQ(s.media[0].mean_free_path.r, 5);
  EXPECT_DOUBLE_EQ(s.media[0].mean_free_path.g, 4);
  EXPECT_DOUBLE_EQ(s.media[0].albedo.b, 0.25);
  EXPECT_EQ(s.media[0].phase, "henyey-greenstein, g = 0.25");
  EXPECT_TRUE(s.media[0].camera_inside);
  EXPECT_DOUBLE_EQ(s.media[0].to_target, 2.5);
  EXPECT_DOUBLE_EQ(s.media[0].exit.value(), 3.5);
}

TEST(Summary, counts) {
  const Summary s = summary_with({"image.width=100", "image.height=50"});
  EXPECT_EQ(s.objects, 1u);
  EXPECT_EQ(s.triangles, 12u);
  EXPECT_EQ(s.spheres, 0u);
  EXPECT_DOUBLE_EQ(s.bounds.min.z, -2);
  EXPECT_NEAR(s.bounds.max.y, -0.9, 1e-7) << "meshes are kept in float";
  EXPECT_GT(s.memory.geometry, 12u * 12u);
  EXPECT_EQ(s.memory.film % 5000, 0u);
}

TEST(Summary, of_a_good_scene_has_no_warnings) {
  EXPECT_THAT(summary_with({}).warnings, ::testing::IsEmpty());
}

TEST(Summary, tells_how_much_of_the_fog_is_lit) {
  EXPECT_DOUBLE_EQ(summary_with({}).lights.at(0).lit_part.value(), 1);
  // A lid over half of the room.
  const Summary half = summary_with({"objects.0.min=[-1,1,-2]", "objects.0.max=[0,1.1,2]"});
  // What the camera sees is symmetric about x = 0, and sampled with a few thousand points.
  EXPECT_NEAR(half.lights.at(0).lit_part.value(), 0.5, 0.02);
}

TEST(Summary, remarks) {
  const auto remarks = [](const std::vector<Override>& changes) {
    return summary_with(changes).remarks;
  };
  EXPECT_THAT(remarks({}), ::testing::IsEmpty());
  EXPECT_THAT(remarks({"camera.position=[0,0,5]"}),
              Contains(HasSubstr("the camera is outside the fog, which begins 3 m ahead")));
  EXPECT_THAT(remarks({"objects=[]"}), Contains(StartsWith("no objects")));
  EXPECT_THAT(remarks({"ambient=1"}), Contains(StartsWith("ambient lights surfaces only")));
}

TEST(Summary, of_a_picture_warns_of_fog_without_light) {
  const auto warnings = [](const std::vector<Override>& changes) {
    Scene scene = parse_scene(room, "room", changes);
    scene.resolution = {16, 9};
    scene.render.spp = 1;
    return warnings_after(scene, render(scene).film);
  };
  const std::string lid = "objects.0.min=[-2,1,-3]", to = "objects.0.max=[2,1.1,3]";
  EXPECT_THAT(warnings({}), ::testing::IsEmpty());
  const std::string no_light = "no light reaches the fog in the picture: ";
  const std::string itself = "it is out of view or too thick";
  EXPECT_THAT(warnings({lid, to}), Contains(no_light + "objects shadow all of it, or " + itself));
  EXPECT_THAT(warnings({"objects=[]", "camera.target=[0,0,9]", "camera.position=[0,0,3]"}),
              Contains(no_light + itself));
  EXPECT_THAT(warnings({lid, to, "media.0.emission=1"}), ::testing::IsEmpty());
  EXPECT_THAT(warnings({lid, to, "lights.0.irradiance=0"}), ::testing::IsEmpty())
      << "which is told before";
  const std::vector<Override> beam = {
      "lights=[{type='collimated', irradiance=1, position=[9,2,0], direction=[0,-1,0], "
      "cross_section={type='circle', radius=0.1}}]",
      "objects=[]"};
  EXPECT_THAT(warnings(beam), Contains(no_light + "beams miss it, or " + itself));
  const Scene dark = parse_scene(room, "room", {lid, to});
  RenderControl at_once;
  at_once.time_limit = 1e-9;
  const Film nothing = Renderer(dark).render(dark.render, at_once).film;
  EXPECT_THAT(warnings_after(dark, nothing), ::testing::IsEmpty())
      << "cut short, it shows nothing at all";
}

TEST(Summary, of_fog_without_an_end_warns_of_what_is_in_view) {
  const std::string endless = "media.0.shape={type='unbounded'}";
  EXPECT_THAT(summary_with({endless, "lights=[]"}).warnings,
              Not(Contains(StartsWith("fog is opaque"))));
  EXPECT_THAT(summary_with({endless, "lights=[]", "camera.position=[0,0,99]"}).warnings,
              Contains(HasSubstr("100 m of it between the camera and its target")));
}

TEST(Summary, of_fog_that_glows_says_that_it_is_not_dark_and_may_be_too_bright) {
  const auto warnings = [](std::vector<Override> changes) {
    changes.emplace_back("lights=[]");
    return summary_with(changes).warnings;
  };
  const auto dark = StartsWith("no light: the fog");
  const auto bright = HasSubstr("bright without end");
  EXPECT_THAT(warnings({}), Contains(dark));
  EXPECT_THAT(warnings({"media.0.emission=[0,0,1]"}), Not(Contains(dark)));
  const std::string endless = "media.0.shape={type='unbounded'}", glow = "media.0.emission=[0,0,1]";
  const std::string clear = "media.0.sigma_s=[1,1,0]", black = "media.0.sigma_a=[1,1,0]";
  EXPECT_THAT(warnings({endless, glow, clear, black}), Contains(bright));
  EXPECT_THAT(warnings({glow, clear, black}), Not(Contains(bright)));
  EXPECT_THAT(warnings({endless, glow, clear}), Not(Contains(bright)));
  EXPECT_THAT(warnings({endless, "media.0.emission=[1,0,0]", clear, black}), Not(Contains(bright)));
}

TEST(Summary, warns) {
  const auto warnings = [](const std::vector<Override>& changes) {
    return summary_with(changes).warnings;
  };
  EXPECT_THAT(warnings({"media.0.sigma_s=15", "media.0.sigma_a=0"}),
              Contains(StartsWith("fog is opaque after 0.31 m")));
  EXPECT_THAT(warnings({"camera.position=[0,0,5]", "camera.target=[0,0,9]"}),
              Contains(HasSubstr("does not look into it")));
  EXPECT_THAT(warnings({"lights=[]"}), Contains(StartsWith("no light")));
  EXPECT_THAT(warnings({"lights.0.irradiance=0"}), Contains(StartsWith("lights.0 is black")));
  EXPECT_THAT(warnings({"media=[]"}), Contains(StartsWith("no medium")));
  EXPECT_THAT(warnings({"media=[]", "objects=[]"}), Contains(StartsWith("the scene is empty")));
  EXPECT_THAT(warnings({"media.0.sigma_s=0"}), Contains(HasSubstr("scatters nothing")));
  EXPECT_THAT(warnings({"objects.0.min=[-2,1,-3]", "objects.0.max=[2,1.1,3]"}),
              Contains(StartsWith("lights.0 cannot enter")));
  const auto warns = Contains(HasSubstr("m above it; move the scene to the origin"));
  EXPECT_THAT(warnings({"objects.0.translate=[-1000,0,0]"}), warns);
  EXPECT_THAT(warnings({"objects.0.translate=[-20,0,0]"}), Not(warns));
  EXPECT_THAT(warnings({"render.estimator=magic"}), Contains(HasSubstr("magic")));
}

}  // namespace
}  // namespace airlight
