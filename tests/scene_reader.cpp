// What a scene file says, what it means, and what is said about its mistakes.

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "error.h"
#include "scene/load_scene.h"

namespace airlight {
namespace {

using ::testing::HasSubstr;

const std::string fog = R"(
[[media]]
sigma_s = 0.4
sigma_a = 0.1
shape = {type = "box"}
)";

/// The error of a scene file "fog.toml", or "" if it is accepted.
std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_scene(text, "fog.toml", overrides);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

TEST(SceneReader, takes_an_empty_file_for_the_defaults) {
  const Scene scene = parse_scene("", "fog.toml");
  EXPECT_EQ(scene.resolution.width, 640);
  EXPECT_EQ(scene.camera.position, Vec3<double>(0, 0, 5));
  EXPECT_FALSE(scene.medium);
}

TEST(SceneReader, names_the_accepted_keys_of_a_table) {
  EXPECT_EQ(error_of("[[media]]\nsigma_q = 1\n"),
            "fog.toml:2:1: media.0.sigma_q is not known here; accepted: albedo, emission, phase, "
            "shape, sigma_a, sigma_s, sigma_t, visibility");
}

TEST(SceneReader, says_what_is_accepted_where_a_number_is_out_of_range) {
  EXPECT_EQ(error_of(fog + "phase = {type = \"henyey-greenstein\", g = 1.2}\n"),
            "fog.toml:6:42: media.0.phase.g = 1.2 is out of range: a number in (-1, 1) (mean "
            "cosine of the scattering angle; 0 is isotropic, above 0 forward)");
}

}  // namespace airlight
