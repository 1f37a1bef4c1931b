#include "image/texture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "error.h"
#include "image/atomic_file.h"
#include "image/output.h"
#include "support/folder.h"
#include "support/random.h"

using namespace airlight;
using testing::ElementsAre;
using testing::FloatEq;
using testing::FloatNear;

namespace {

/// Two by two texels, linear: red counts 0, 51 on top and 102, 255 below; alpha goes the other way.
Texture four_texels() {
  Texture texture{2, 2, {0, 0, 0, 255, 51, 0, 0, 102, 102, 0, 0, 51, 255, 0, 0, 0}};
  texture.srgb = false;
  return texture;
}

constexpr float top_left = 0;
constexpr float top_right = 0.2F;
constexpr float bottom_left = 0.4F;
constexpr float bottom_right = 1;
constexpr float rounding = 1e-6F;

}  // namespace

TEST(Texture, gives_texels_at_their_centres_with_v_up) {
  const Texture t = four_texels();
  EXPECT_THAT(t.sample(0.25F, 0.75F)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(0.75F, 0.75F)[0], FloatNear(top_right, rounding));
  EXPECT_THAT(t.sample(0.25F, 0.25F)[0], FloatNear(bottom_left, rounding));
  EXPECT_THAT(t.sample(0.75F, 0.25F)[0], FloatNear(bottom_right, rounding));
  EXPECT_THAT(t.sample(0.25F, 0.25F)[3], FloatNear(0.2F, rounding));
}

TEST(Texture, is_bilinear_between_centres) {
  const Texture t = four_texels();
  EXPECT_THAT(t.sample(0.5F, 0.75F)[0], FloatNear((top_left + top_right) / 2, rounding));
  EXPECT_THAT(t.sample(0.5F, 0.5F)[0], FloatNear(0.4F, rounding));  // the mean of all four
  // A quarter of the way right, three quarters of the way up.
  EXPECT_THAT(
      t.sample(0.375F, 0.625F)[0],
      FloatNear(0.75F * (0.75F * 0 + 0.25F * 0.2F) + 0.25F * (0.75F * 0.4F + 0.25F * 1), rounding));
}

TEST(Texture, repeats) {
  const Texture t = four_texels();
  EXPECT_THAT(t.sample(0, 0.75F)[0], FloatNear((top_left + top_right) / 2, rounding));
  EXPECT_THAT(t.sample(0.25F, 1)[0], FloatNear((top_left + bottom_left) / 2, rounding));
  for (const float period : {-3.0F, -1.0F, 1.0F, 5.0F})
    EXPECT_THAT(t.sample(0.375F + period, 0.625F - period)[0],
                FloatNear(t.sample(0.375F, 0.625F)[0], 1e-5F));  // u is rounded to 2^-22
}

TEST(Texture, clamps) {
  Texture t = four_texels();
  t.wrap_u = t.wrap_v = Wrap::clamp;
  EXPECT_THAT(t.sample(0, 0.75F)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(-7, 9)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(7, -9)[0], FloatNear(bottom_right, rounding));
}

TEST(Texture, mirrors) {
  Texture t = four_texels();
  t.wrap_u = t.wrap_v = Wrap::mirror;
  EXPECT_THAT(t.sample(0, 0.75F)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(1.25F, 0.75F)[0], FloatNear(top_right, rounding));
  EXPECT_THAT(t.sample(1.75F, 0.75F)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(-0.25F, 0.75F)[0], FloatNear(top_left, rounding));
  EXPECT_THAT(t.sample(2.25F, -1.25F)[0], FloatNear(top_left, rounding));
}

TEST(Texture, wraps_each_axis_by_itself) {
  Texture t = four_texels();
  t.wrap_u = Wrap::clamp;
  EXPECT_THAT(t.sample(3, 1.75F)[0], FloatNear(top_right, rounding));
}

TEST(Texture, decodes_srgb_before_it_filters_and_leaves_alpha_linear) {
  const Texture t{2, 1, {0, 188, 255, 0, 0, 0, 0, 128}};
  const auto centre = t.sample(0.25F, 0.5F);
  EXPECT_THAT(centre[1], FloatNear(0.5029F, 1e-4F));  // ((188 / 255 + 0.055) / 1.055)^2.4
  EXPECT_THAT(t.sample(0.5F, 0.5F)[2], FloatEq(0.5F));
  EXPECT_THAT(t.sample(0.5F, 0.5F)[3], FloatEq(64 / 255.0F));
}

TEST(Texture, stays_inside_for_any_coordinates) {
  Texture t = four_texels();
  const float extremes[] = {
      -1e-9F,  -1e30F,  1e30F,     std::nanf(""), std::numeric_limits<float>::infinity(),
      -1e-40F, 0x1p31F, -0x1.8p23F};
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    t.wrap_u = t.wrap_v = wrap;
    for (const float u : extremes)
      for (const float v : extremes) {
        const float red = t.sample(u, v)[0];
        EXPECT_TRUE(red >= 0 && red <= 1 + rounding) << u << ' ' << v;
      }
  }
}

TEST(Texture, gives_one_channel_as_it_gives_all) {
  Texture t{3, 2, {}};
  for (int i = 0; i < 24; ++i) t.rgba.push_back(std::uint8_t(37 * i));
  test::Random random(1);
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (const bool srgb : {false, true})
      for (int i = 0; i < 200; ++i) {
        t.wrap_u = t.wrap_v = wrap, t.srgb = srgb;
        const auto u = float(random.uniform(-3, 3)), v = float(random.uniform(-3, 3));
        for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(t.sample(u, v, c), t.sample(u, v)[c]);
      }
}

TEST(Texture, is_loaded_from_a_file_with_its_codes_as_they_are) {
  const test::Folder folder;
  Image image(2, 1);
  image.pixels = {0, 0.5F, 1, 1, 0, 0};
  write_png(folder / "t.png", picture_of(image));
  const Texture t = load_texture(folder / "t.png");
  EXPECT_EQ(t.width, 2);
  EXPECT_EQ(t.height, 1);
  EXPECT_TRUE(t.srgb);
  EXPECT_THAT(t.rgba, ElementsAre(0, 188, 255, 255, 255, 0, 0, 255));
}

TEST(Texture, names_the_file_that_is_none) {
  const test::Folder folder;
  write_text(folder / "leaf.png", "hello");
  try {
    load_texture(folder / "leaf.png");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("leaf.png: cannot be read: it is no picture"));
    EXPECT_THAT(error.what(), testing::EndsWith("; accepted: PNG, JPEG, BMP, TGA"));
  }
  EXPECT_THROW(decode_texture({}, "buffer 0"), Error);
}
