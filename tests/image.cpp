// Pictures through files: what is written is what is read, or an Error.
#include "image/image.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <png.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>  // jpeglib.h wants it first
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include <jpeglib.h>

#include "error.h"
#include "image/atomic_file.h"
#include "image/decoders.h"
#include "image/input.h"
#include "image/output.h"
#include "image/read_file.h"
#include "image/srgb.h"
#include "support/error_of.h"
#include "support/folder.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

using namespace airlight;
using airlight::test::error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Pair;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Values from dark to bright of both signs, different in every place.
Image noise(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  std::mt19937 random(7);
  for (float& value : image.pixels)
    value = std::exp2(float(random() % 2000) / 100 - 10) * (random() % 8 == 0 ? -1.0F : 1.0F);
  return image;
}

Layer layer_of(const std::string& name, std::vector<std::string> channels, const Image& image,
               Storage storage = Storage::colour) {
  return {name, std::move(channels),
          [&image](int y, std::span<float> row) { std::ranges::copy(image.row(y), row.begin()); },
          storage};
}

Image one_row(std::vector<float> values) {
  Image image(int(values.size() / 3), 1);
  image.pixels = std::move(values);
  return image;
}

/// The 8 bit codes of a PNG, alpha left out.
std::vector<int> codes_in(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  std::vector<int> codes;
  const std::vector<std::uint8_t> rgba = decode_codes({bytes, name}).rgba;
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (i % 4 != 3) codes.push_back(rgba[i]);
  return codes;
}

/// A PNG of one pixel in any of libpng's formats.
void write_pixel(png_uint_32 format, const void* codes, const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = header.height = 1;
  header.format = format;
  ASSERT_TRUE(png_image_write_to_file(&header, path.c_str(), 0, codes, 0, nullptr));
}

/// What is read from a grey PNG of one pixel of 16 bit.
float wide_pixel(const std::string& path, std::uint16_t code) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 1, 1, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const png_byte row[] = {png_byte(code >> 8), png_byte(code & 255)};
  png_write_row(png, row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  return read_image(path).at(0, 0, 0);
}

class EveryFormat : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Picture, EveryFormat, testing::Values("exr", "pfm", "png"),
                         [](const auto& info) { return info.param; });

}  // namespace

TEST(Exr, keeps_single_precision_exactly) {
  const test::Folder folder;
  for (const auto& [width, height] : {std::pair(37, 50), std::pair(1, 1), std::pair(3, 16)}) {
    const Image image = noise(width, height);
    write_exr(folder / "a.exr", picture_of(image), ExrType::single);
    const Image read = read_image(folder / "a.exr");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

TEST(Exr, rounds_half_precision_to_the_nearest) {
  const test::Folder folder;
  const Image image = noise(20, 20);
  write_exr(folder / "a.exr", picture_of(image), ExrType::half);
  const Image read = read_image(folder / "a.exr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)  // 11 significant bits
    EXPECT_LE(std::abs(read.pixels[i] - image.pixels[i]), 0x1p-11F * std::abs(image.pixels[i]));
}

TEST(Exr, clamps_what_half_precision_cannot_hold) {
  const test::Folder folder;
  const Image image = one_row({1e30F, -70000, 65519, 65520, 65504, 1});
  write_exr(folder / "a.exr", picture_of(image), ExrType::half);
  EXPECT_THAT(read_image(folder / "a.exr").pixels,
              ElementsAre(65504, -65504, 65504, 65504, 65504, 1));
}

TEST(Exr, keeps_every_layer_with_its_precision) {
  const test::Folder folder;
  const Image beauty = noise(9, 20);
  const Image normal = noise(9, 20);
  Image depth = noise(9, 20, 1);
  Image id(9, 20, 1);
  for (std::size_t i = 0; i < id.pixels.size(); ++i) id.pixels[i] = float((1 << 24) - i);
  Picture picture = picture_of(beauty);
  picture.layers.push_back(layer_of("normal", {"X", "Y", "Z"}, normal));
  picture.layers.push_back(layer_of("in_scatter", {"R", "G", "B"}, normal, Storage::single));
  picture.layers.push_back(layer_of("depth", {"Z"}, depth, Storage::single));
  picture.layers.push_back(layer_of("object_id", {"id"}, id, Storage::id));
  write_exr(folder / "a.exr", picture, ExrType::half);

  EXPECT_EQ(read_image(folder / "a.exr", "depth").pixels, depth.pixels);
  EXPECT_EQ(read_image(folder / "a.exr", "depth").channels, 1);
  EXPECT_EQ(read_image(folder / "a.exr", "object_id").pixels, id.pixels);
  EXPECT_EQ(read_image(folder / "a.exr", "in_scatter").pixels, normal.pixels);
  EXPECT_NEAR(read_image(folder / "a.exr", "normal").at(8, 19, 2), normal.at(8, 19, 2),
              std::abs(normal.at(8, 19, 2)) * 0x1p-11);

  const Imf::InputFile file((folder / "a.exr").c_str());
  const auto type = [&](const char* channel) { return file.header().channels()[channel].type; };
  EXPECT_EQ(type("R"), Imf::HALF);
  EXPECT_EQ(type("normal.Y"), Imf::HALF);
  EXPECT_EQ(type("in_scatter.G"), Imf::FLOAT);
  EXPECT_EQ(type("depth.Z"), Imf::FLOAT);
  EXPECT_EQ(type("object_id.id"), Imf::UINT);
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
}

TEST(Exr, names_the_channels_it_has_when_a_layer_is_missing) {
  const test::Folder folder;
  const Image image = noise(2, 2);
  write_exr(folder / "a.exr", picture_of(image), ExrType::half);
  EXPECT_EQ(
      error_of([&] { read_image(folder / "a.exr", "surface"); }),
      (folder / "a.exr").string() +
          ": cannot be read: it has no channels surface.R, surface.G, surface.B; it has: B, G, R");
}

TEST(Exr, places_a_crop_in_the_whole) {
  const test::Folder folder;
  const Image image = noise(30, 40);
  Picture picture = picture_of(image);
  picture.crop = Crop{100, 200, 640, 480};
  write_exr(folder / "a.exr", picture, ExrType::single);
  const Imf::InputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({100, 200}, {129, 239}));
  EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {639, 479}));
  const Image whole = read_image(folder / "a.exr");
  ASSERT_EQ(std::pair(whole.width, whole.height), std::pair(640, 480));
  EXPECT_EQ(whole.at(100, 200, 0), image.at(0, 0, 0));
  EXPECT_EQ(whole.at(129, 239, 2), image.at(29, 39, 2));
  EXPECT_EQ(std::accumulate(whole.pixels.begin(), whole.pixels.end(), 0.),
            std::accumulate(image.pixels.begin(), image.pixels.end(), 0.));
  EXPECT_THAT(error_of([&] { read_radiance(folder / "a.exr"); }),
              EndsWith("it is a crop of its picture; accepted: a whole one"));
}

TEST(Exr, is_read_without_what_lies_beyond_its_picture) {
  const test::Folder folder;
  const Image image = noise(30, 40);
  Picture picture = picture_of(image);
  picture.crop = Crop{-5, -7, 20, 28};
  const Image depth(30, 40, 1);
  picture.layers.push_back(layer_of("depth", {"Z"}, depth, Storage::single));
  write_exr(folder / "a.exr", picture, ExrType::single);
  for (const Image& inside : {read_image(folder / "a.exr"), *read_radiance(folder / "a.exr")}) {
    ASSERT_EQ(std::pair(inside.width, inside.height), std::pair(20, 28));
    for (int y = 0; y < 28; ++y)
      for (int x = 0; x < 20; ++x)
        for (int c = 0; c < 3; ++c) ASSERT_EQ(inside.at(x, y, c), image.at(x + 5, y + 7, c));
  }
  EXPECT_EQ(read_numbers(folder / "a.exr").image.width, 20);
}

TEST(Exr, keeps_metadata) {
  const test::Folder folder;
  const Image image = noise(2, 2);
  Picture picture = picture_of(image);
  picture.metadata = {{"estimator", "rewv"},
                      {"seconds", 0.1},
                      {"seed", std::int64_t{1} << 40},
                      {"spp", std::int64_t{-64}},
                      {"title", "Fog über Ålesund"}};
  write_exr(folder / "a.exr", picture, ExrType::half);
  EXPECT_THAT(
      read_metadata(folder / "a.exr"),
      ElementsAre(Pair("estimator", "rewv"), Pair("seconds", "0.1"), Pair("seed", "1099511627776"),
                  Pair("spp", "-64"), Pair("title", "Fog über Ålesund")));
}

TEST(Pfm, keeps_values_exactly) {
  const test::Folder folder;
  const Image image = noise(31, 17);
  write_pfm(folder / "a.pfm", picture_of(image));
  const Image read = read_image(folder / "a.pfm");
  EXPECT_EQ(read.width, 31);
  EXPECT_EQ(read.pixels, image.pixels);
}

TEST(Pfm, is_the_format_byte_for_byte) {
  const test::Folder folder;
  Image image(1, 2);
  image.pixels = {1, 2, 3, -0.5F, 0, 0};
  write_pfm(folder / "a.pfm", picture_of(image));
  using namespace std::string_literals;
  EXPECT_EQ(read_text(folder / "a.pfm"),
            "PF\n1 2\n-1.0\n"
            "\0\0\0\xbf\0\0\0\0\0\0\0\0"
            "\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40"s);
}

TEST(Pfm, is_read_in_grey_and_in_the_other_byte_order) {
  const test::Folder folder;
  using namespace std::string_literals;
  write_text(folder / "a.pfm", "Pf 2 1 1.0\n\x3f\x80\0\0\x40\0\0\0"s);
  EXPECT_THAT(read_image(folder / "a.pfm").pixels, ElementsAre(1, 1, 1, 2, 2, 2));
}

TEST(Srgb, knows_its_codes) {
  EXPECT_EQ(linear_of_srgb[0], 0);
  EXPECT_EQ(linear_of_srgb[255], 1);
  EXPECT_NEAR(linear_of_srgb[10], 10 / 255.0 / 12.92, 1e-9);
  EXPECT_NEAR(linear_of_srgb[128], 0.2158605, 1e-7);  // IEC 61966-2-1
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb_of_linear(linear_of_srgb[std::size_t(code)]), code);
  EXPECT_EQ(srgb_of_linear(-1), 0);
  EXPECT_EQ(srgb_of_linear(7), 255);
  EXPECT_EQ(srgb_of_linear(0.18F), 118);
}

TEST(Png, holds_srgb_codes_of_the_light) {
  const test::Folder folder;
  write_png(folder / "a.png", picture_of(one_row({0, 0.5F, 1, -3, 0.18F, 40})));
  EXPECT_THAT(codes_in(folder / "a.png"), ElementsAre(0, 188, 255, 0, 118, 255));
}

TEST(Png, is_read_back_as_linear_light) {
  const test::Folder folder;
  Image image(256, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = linear_of_srgb[std::size_t((x + 80 * c + y) % 256)];
  write_png(folder / "a.png", picture_of(image));
  EXPECT_EQ(read_image(folder / "a.png").pixels, image.pixels);
}

TEST(Png, is_exposed_in_stops) {
  const test::Folder folder;
  write_png(folder / "a.png", picture_of(one_row({0.25F, 0.125F, 0.0625F})), {1, ToneMap::none});
  write_png(folder / "b.png", picture_of(one_row({0.5F, 0.25F, 0.125F})));
  EXPECT_EQ(codes_in(folder / "a.png"), codes_in(folder / "b.png"));
}

TEST(Png, takes_the_filmic_curve) {
  const test::Folder folder;
  // 0.18 (2.51 0.18 + 0.03) / (0.18 (2.43 0.18 + 0.59) + 0.14) = 0.26689; 2.54 / 3.16 = 0.80380.
  EXPECT_NEAR(filmic(0.18F), 0.26689F, 1e-5F);
  EXPECT_NEAR(filmic(1), 0.80380F, 1e-5F);
  EXPECT_EQ(filmic(0), 0);
  EXPECT_EQ(filmic(std::numeric_limits<float>::max()), 1);
  write_png(folder / "a.png", picture_of(one_row({0, 0.18F, 1})), {0, ToneMap::filmic});
  EXPECT_THAT(codes_in(folder / "a.png"), ElementsAre(0, 141, 232));
}

TEST(Png, keeps_metadata) {
  const test::Folder folder;
  const Image image = noise(2, 2);
  Picture picture = picture_of(image);
  picture.metadata = {{"estimator", "rewv"},
                      {"seconds", 0.1},
                      {"seed", std::int64_t{1} << 40},
                      {"title", "Fog über Ålesund"}};
  write_png(folder / "a.png", picture);
  EXPECT_THAT(read_metadata(folder / "a.png"),
              ElementsAre(Pair("estimator", "rewv"), Pair("seconds", "0.1"),
                          Pair("seed", "1099511627776"), Pair("title", "Fog über Ålesund")));
}

TEST(Png, is_read_in_16_bit_and_over_black) {
  const test::Folder folder;
  const png_uint_16 wide[] = {65535, 32768, 1000};
  write_pixel(PNG_FORMAT_LINEAR_RGB, wide, folder / "wide.png");
  const Image linear = read_image(folder / "wide.png");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear.at(0, 0, c), wide[c] / 65535.0, 1 / 65535.0);

  // Without a word about gamma, codes are sRGB's, as those of 8 bit.
  for (const int code : {1, 5, 100, 255})
    EXPECT_NEAR(wide_pixel(folder / "codes.png", std::uint16_t(code * 257)), linear_of_srgb[code],
                1e-7);

  const std::uint8_t clear[] = {200, 100, 255, 0};
  write_pixel(PNG_FORMAT_RGBA, clear, folder / "clear.png");
  EXPECT_THAT(read_image(folder / "clear.png").pixels, ElementsAre(0, 0, 0));

  const std::uint8_t grey[] = {128};
  write_pixel(PNG_FORMAT_GRAY, grey, folder / "grey.png");
  const float value = linear_of_srgb[128];
  EXPECT_THAT(read_image(folder / "grey.png").pixels, ElementsAre(value, value, value));
}

TEST(Png, of_numbers_has_no_transparent_grey) {
  const test::Folder folder;
  const std::string path = folder / "a.png";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 64, 64, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_color_16 clear{};
  png_set_tRNS(png, info, nullptr, 0, &clear);
  png_write_info(png, info);
  const std::vector<png_byte> row(64, 7);
  for (int y = 0; y < 64; ++y) png_write_row(png, row.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  EXPECT_THAT(error_of([&] { read_numbers(path); }),
              EndsWith("it has a transparent grey; accepted: a grey PNG without alpha"));
  EXPECT_EQ(read_image(path).at(63, 63, 2), linear_of_srgb[7]);
}

TEST(Png, of_8_bit_is_laid_over_black_as_one_of_16_bit) {
  const test::Folder folder;
  for (int alpha = 5; alpha < 256; alpha += 50) {
    const std::uint8_t codes[] = {255, 100, 3, std::uint8_t(alpha)};
    write_pixel(PNG_FORMAT_RGBA, codes, folder / "a.png");
    const Image image = read_image(folder / "a.png");
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.at(0, 0, c), linear_of_srgb[codes[c]] * float(alpha) / 255, 1e-6) << alpha;
  }
}

TEST(Exr, of_luminance_is_grey) {
  const test::Folder folder;
  Image grey(3, 2, 1);
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) grey.pixels[i] = 0.25F * float(i);
  Picture picture;
  picture.width = 3, picture.height = 2;
  picture.layers.push_back(layer_of("", {"Y"}, grey, Storage::single));
  write_exr(folder / "y.exr", picture, ExrType::single);
  const Image image = read_image(folder / "y.exr");
  ASSERT_EQ(image.channels, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_EQ(image.pixels[i], grey.pixels[i / 3]);
}

TEST(Codes, are_those_of_the_file) {
  const test::Folder folder;
  const auto codes_of = [&](png_uint_32 format, const void* codes) {
    write_pixel(format, codes, folder / "a.png");
    const std::vector<std::byte> bytes = read_file(folder / "a.png");
    const std::string name = "a.png";
    return decode_codes({bytes, name}).rgba;
  };
  const std::uint8_t codes[] = {200, 100, 255, 7};
  EXPECT_THAT(codes_of(PNG_FORMAT_RGBA, codes), ElementsAre(200, 100, 255, 7));
  EXPECT_THAT(codes_of(PNG_FORMAT_RGB, codes), ElementsAre(200, 100, 255, 255));
  EXPECT_THAT(codes_of(PNG_FORMAT_GA, codes), ElementsAre(200, 200, 200, 100));
  const png_uint_16 wide[] = {65535, 257 * 128,
                              0};  // linear light, so says its gAMA chunk: not heeded
  EXPECT_THAT(codes_of(PNG_FORMAT_LINEAR_RGB, wide), ElementsAre(255, 128, 0, 255));
}

TEST(ReadImage, takes_what_others_write) {
  const test::Folder folder;
  const std::uint8_t codes[] = {255, 128, 0, 10, 20, 30};
  ASSERT_TRUE(stbi_write_bmp((folder / "a.bmp").c_str(), 2, 1, 3, codes));
  ASSERT_TRUE(stbi_write_tga((folder / "a.tga").c_str(), 2, 1, 3, codes));
  ASSERT_TRUE(stbi_write_png((folder / "a.png").c_str(), 2, 1, 3, codes, 6));
  for (const char* name : {"a.bmp", "a.tga", "a.png"}) {
    const Image image = read_image(folder / name);
    ASSERT_EQ(image.pixels.size(), 6U) << name;
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(image.pixels[i], linear_of_srgb[codes[i]]) << name;
  }

  const std::vector<std::uint8_t> grey(3 * 64, 128);
  ASSERT_TRUE(stbi_write_jpg((folder / "a.jpg").c_str(), 8, 8, 3, grey.data(), 100));
  EXPECT_EQ(read_image(folder / "a.jpg").at(3, 3, 1), linear_of_srgb[128]);
  const std::vector<std::uint8_t> bytes(64, 50);
  ASSERT_TRUE(stbi_write_jpg((folder / "grey.jpg").c_str(), 8, 8, 1, bytes.data(), 100));
  EXPECT_EQ(read_image(folder / "grey.jpg").at(7, 0, 2), linear_of_srgb[50]);

  const float light[] = {1, 0.5F, 0, 16, 8, 4};  // exact in RGBE
  ASSERT_TRUE(stbi_write_hdr((folder / "a.hdr").c_str(), 2, 1, 3, light));
  EXPECT_THAT(read_image(folder / "a.hdr").pixels, testing::ElementsAreArray(light));
}

TEST(ReadImage, takes_run_lengths_of_radiance_files) {
  const test::Folder folder;
  Image image(300, 2);
  for (int x = 0; x < 300; ++x)
    for (int y = 0; y < 2; ++y)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = x < 200 ? 0.25F : std::exp2(float(x % 7 + c));
  ASSERT_TRUE(stbi_write_hdr((folder / "a.hdr").c_str(), 300, 2, 3, image.pixels.data()));
  EXPECT_LT(std::filesystem::file_size(folder / "a.hdr"), 300U * 2 * 4);
  EXPECT_EQ(read_image(folder / "a.hdr").pixels, image.pixels);  // powers of two are exact in RGBE
}

/// A Radiance file of these header lines and pixels.
void write_radiance(const std::filesystem::path& path, const std::string& lines, int width,
                    const std::vector<std::uint8_t>& pixels) {
  write_text(path, fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{}\n-Y 1 +X {}\n{}", lines,
                               width, std::string(pixels.begin(), pixels.end())));
}

TEST(ReadImage, takes_repeated_pixels_of_old_radiance_files) {
  const test::Folder folder;
  // One pixel, again 2 times; another, again 3 + 1 * 256 times, the count in two parts.
  write_radiance(folder / "a.hdr", "", 3 + 260,
                 {128, 64, 32, 129, 1, 1, 1, 2, 128, 128, 128, 130, 1, 1, 1, 3, 1, 1, 1, 1});
  const Image image = read_image(folder / "a.hdr");
  ASSERT_EQ(image.width, 263);
  for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(x, 0, 1), 0.5F);
  for (int x = 3; x < 263; ++x) ASSERT_EQ(image.at(x, 0, 1), 2.0F) << x;
  write_radiance(folder / "b.hdr", "", 4, {128, 64, 32, 129, 1, 1, 1, 4});
  EXPECT_THAT(error_of([&] { read_image(folder / "b.hdr"); }), HasSubstr("does not fit its row"));
  write_radiance(folder / "c.hdr", "", 4, {1, 1, 1, 4});
  EXPECT_THAT(error_of([&] { read_image(folder / "c.hdr"); }), HasSubstr("does not fit its row"));
}

TEST(ReadImage, takes_back_the_exposure_of_radiance_files) {
  const test::Folder folder;
  const std::vector<std::uint8_t> pixel = {128, 128, 128, 130};  // 2, 2, 2
  write_radiance(folder / "a.hdr", "EXPOSURE=4\nEXPOSURE= 0.5 \nCOLORCORR= 1 2 0.25\n", 1, pixel);
  EXPECT_THAT(read_image(folder / "a.hdr").pixels, ElementsAre(1, 0.5F, 4));
  for (const char* bad : {"EXPOSURE=bright\n", "EXPOSURE=0\n", "COLORCORR=1 2\n"}) {
    write_radiance(folder / "b.hdr", bad, 1, pixel);
    EXPECT_THAT(error_of([&] { read_image(folder / "b.hdr"); }), HasSubstr("above 0")) << bad;
  }
}

/// A JPEG file whose EXIF data say how it is turned, little-endian or big.
void write_turned(const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb,
                  int width, int height, int orientation, bool little) {
  ASSERT_TRUE(stbi_write_jpg(path.c_str(), width, height, 3, rgb.data(), 100));
  const std::string jpeg = read_text(path);
  const auto number = [&](std::size_t bytes, unsigned value) {
    std::string text(bytes, '\0');
    for (std::size_t i = 0; i < bytes; ++i)
      text[little ? i : bytes - 1 - i] = char(value >> (8 * i) & 255);
    return text;
  };
  // A resolution comes first, so that the entry is looked for.
  const std::string tiff = (little ? "II" : "MM") + number(2, 42) + number(4, 8) + number(2, 2) +
                           number(2, 0x128) + number(2, 3) + number(4, 1) + number(2, 2) +
                           number(2, 0) + number(2, 0x112) + number(2, 3) + number(4, 1) +
                           number(2, unsigned(orientation)) + number(2, 0) + number(4, 0);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const std::size_t size = exif.size() + 2;
  write_text(path, jpeg.substr(0, 2) + "\xff\xe1" + char(size >> 8) + char(size & 255) + exif +
                       jpeg.substr(2));
}

TEST(ReadImage, turns_photographs_as_they_say) {
  const test::Folder folder;
  // What is to be seen: 32 x 16 pixels, dark on the left, and white in the upper right quarter.
  const auto seen = [](int x, int y) { return x < 16 ? 20 : y < 8 ? 255 : 120; };
  for (int orientation = 1; orientation <= 8; ++orientation) {
    // Where row and column 0 of the file are seen, as EXIF defines it.
    const int width = orientation < 5 ? 32 : 16, height = 48 - width;
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const int right = 31 - (orientation < 5 ? column : row);
        const int down = 15 - (orientation < 5 ? row : column);
        const bool from_right =
            orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
        const bool from_below =
            orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
        const int x = from_right ? right : 31 - right, y = from_below ? down : 15 - down;
        rgb.insert(rgb.end(), 3, std::uint8_t(seen(x, y)));
      }
    write_turned(folder / "a.jpg", rgb, width, height, orientation, orientation % 2 == 0);
    const Image image = read_image(folder / "a.jpg");
    ASSERT_EQ(std::pair(image.width, image.height), std::pair(32, 16)) << orientation;
    for (const int x : {3, 28})
      for (const int y : {3, 12})
        EXPECT_NEAR(image.at(x, y, 0), linear_of_srgb[std::size_t(seen(x, y))], 0.02)
            << orientation << " at " << x << ',' << y;
  }
  std::vector<std::uint8_t> grey(3 * 16 * 8, 120);
  write_turned(folder / "b.jpg", grey, 16, 8, 77, true);  // no orientation
  EXPECT_EQ(read_image(folder / "b.jpg").width, 16);
}

/// A JPEG file of 8 x 8 pixels of four inks, with the mark of Adobe's programs or without.
void write_inks(const std::filesystem::path& path, std::array<JSAMPLE, 4> codes, bool adobe) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  jpeg_error_mgr errors{};
  jpeg_compress_struct state{};
  state.err = jpeg_std_error(&errors);
  jpeg_create_compress(&state);
  jpeg_stdio_dest(&state, file);
  state.image_width = state.image_height = 8;
  state.input_components = 4;
  state.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&state);
  jpeg_set_quality(&state, 100, TRUE);
  state.write_Adobe_marker = adobe ? TRUE : FALSE;
  jpeg_start_compress(&state, TRUE);
  std::array<JSAMPLE, 32> pixels{};
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = codes[i % 4];
  for (JSAMPROW row = pixels.data(); state.next_scanline < 8;)
    jpeg_write_scanlines(&state, &row, 1);
  jpeg_finish_compress(&state);
  jpeg_destroy_compress(&state);
  std::fclose(file);
}

TEST(ReadImage, takes_pictures_in_four_inks) {
  const test::Folder folder;
  const std::array<JSAMPLE, 4> codes = {200, 100, 255, 128};
  for (const bool adobe : {true, false}) {
    write_inks(folder / "a.jpg", codes, adobe);
    const Image image = read_image(folder / "a.jpg");
    ASSERT_EQ(image.width, 8);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto light = [&](std::size_t i) { return adobe ? codes[i] : 255 - codes[i]; };
      const int code = (light(c) * light(3) + 127) / 255;
      EXPECT_NEAR(image.at(3, 3, int(c)), linear_of_srgb[std::size_t(code)], 0.01) << c;
    }
  }
}

TEST(ReadImage, names_the_file_and_the_reason) {
  const test::Folder folder;
  const std::string name = folder.path().string();
  EXPECT_EQ(error_of([&] { read_image(folder / "sun.png"); }),
            name + "/sun.png: cannot be read: No such file or directory");
  write_text(folder / "a.exr", "not a picture at all");
  EXPECT_THAT(error_of([&] { read_image(folder / "a.exr"); }),
              AllOf(HasSubstr("/a.exr: cannot be read: it is no picture of a known format"),
                    HasSubstr("; accepted: PNG, JPEG, BMP, TGA, EXR, HDR, PFM")));
  write_text(folder / "a.pfm", "PF\n1000000000 1000000000\n-1.0\n");
  EXPECT_THAT(error_of([&] { read_image(folder / "a.pfm"); }),
              HasSubstr("1000000000 x 1000000000 pixels"));
  write_text(folder / "b.pfm", "PF\nwide high\n-1.0\n");
  EXPECT_THAT(error_of([&] { read_image(folder / "b.pfm"); }), HasSubstr("its header is not"));
}

TEST(ReadImage, survives_broken_files) {
  const test::Folder folder;
  const Image image = noise(40, 40);
  std::vector<std::uint8_t> codes(40 * 40 * 3);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = std::uint8_t(i * i / 7);
  Picture picture = picture_of(image);
  picture.metadata = {{"spp", std::int64_t{4}}};
  write_exr(folder / "a.exr", picture, ExrType::half);
  write_png(folder / "a.png", picture);
  write_pfm(folder / "a.pfm", picture);
  stbi_write_jpg((folder / "a.jpg").c_str(), 40, 40, 3, codes.data(), 80);
  stbi_write_bmp((folder / "a.bmp").c_str(), 40, 40, 3, codes.data());
  stbi_write_tga((folder / "a.tga").c_str(), 40, 40, 3, codes.data());
  stbi_write_hdr((folder / "a.hdr").c_str(), 40, 40, 3, image.pixels.data());

  std::mt19937 random(1);
  int refused = 0;
  const auto try_to_read = [&](const std::string& bytes) {
    std::ofstream(folder / "broken", std::ios::binary) << bytes;
    try {
      read_metadata(folder / "broken");
      EXPECT_EQ(read_image(folder / "broken").channels, 3);
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("broken: cannot be read: "));
      ++refused;
    }
  };
  for (const char* name : {"a.exr", "a.png", "a.pfm", "a.jpg", "a.bmp", "a.tga", "a.hdr"}) {
    const std::string whole = read_text(folder / name);
    for (int i = 0; i < 40; ++i) try_to_read(whole.substr(0, whole.size() * std::size_t(i) / 40));
    for (int i = 0; i < 100; ++i) {
      std::string flipped = whole;
      for (int k = 0; k < 4; ++k) {
        const std::size_t reach =
            i % 2 == 0 ? std::min<std::size_t>(400, whole.size()) : whole.size();
        flipped[random() % reach] ^= char(1 << random() % 8);
      }
      try_to_read(flipped);
    }
  }
  EXPECT_GT(refused, 300);
}

TEST_P(EveryFormat, is_picked_by_its_extension) {
  const test::Folder folder;
  const Image image = one_row({0, 1, 0.5F});
  const std::string upper =
      GetParam() == std::string("exr") ? "a.EXR" : std::string("a.") + GetParam();
  write_picture(folder / upper, picture_of(image));
  EXPECT_NEAR(read_image(folder / upper).at(0, 0, 2), 0.5, 0.005);  // half a code of a PNG
}

TEST(Picture, has_no_format_without_a_known_extension) {
  const Image image = one_row({0, 1, 0.5F});
  EXPECT_EQ(error_of([&] { write_picture("out.jpg", picture_of(image)); }),
            "out.jpg: unknown picture format \".jpg\"; accepted: .exr, .pfm, .png");
  EXPECT_EQ(error_of([&] { check_picture_path("out"); }),
            "out: unknown picture format \"\"; accepted: .exr, .pfm, .png");
}

TEST_P(EveryFormat, is_checked_before_a_long_render) {
  const test::Folder folder;
  const std::string name = std::string("a.") + GetParam();
  check_picture_path(folder / name);
  EXPECT_EQ(folder.files(), 0U);
  EXPECT_THAT(error_of([&] { check_picture_path(folder / ("no/" + name)); }),
              HasSubstr(": cannot be written: there is no folder "));
  std::filesystem::create_directory(folder / name);
  EXPECT_THAT(error_of([&] { check_picture_path(folder / name); }),
              EndsWith(": cannot be written: it is a folder"));
}

TEST_P(EveryFormat, refuses_what_is_not_finite_and_keeps_the_old_file) {
  const test::Folder folder;
  const auto path = folder / (std::string("a.") + GetParam());
  write_text(path, "old");
  for (const float bad : {not_a_number, std::numeric_limits<float>::infinity()}) {
    Image image = noise(20, 70);
    image.at(3, 66, 1) = bad;
    EXPECT_EQ(error_of([&] { write_picture(path, picture_of(image)); }),
              path.string() + ": layer beauty.G is " + (std::isnan(bad) ? "nan" : "inf") +
                  " at pixel 3,66; accepted: finite numbers");
  }
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Exr, refuses_an_id_that_is_none) {
  const test::Folder folder;
  const Image image = noise(2, 2);
  Image id(2, 2, 1);
  id.at(1, 0, 0) = -1;
  Picture picture = picture_of(image);
  picture.layers.push_back(layer_of("object_id", {"id"}, id, Storage::id));
  EXPECT_THAT(
      error_of([&] { write_picture(folder / "a.exr", picture); }),
      HasSubstr(
          "layer object_id.id is -1 at pixel 1,0; accepted: whole numbers from 0 to 16777216"));
}

TEST_P(EveryFormat, leaves_the_old_file_when_the_disk_is_full) {
  const test::Folder folder;
  const auto path = folder / (std::string("a.") + GetParam());
  write_text(path, "old");
  const Image image = noise(400, 400);
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit{10'000, before.rlim_max};  // no file may grow further
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const std::string error = error_of([&] { write_picture(path, picture_of(image)); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(error, path.string() + ": cannot be written: File too large");
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(folder.files(), 1U);

  const auto full = folder / (std::string("full.") + GetParam());
  std::filesystem::create_symlink("/dev/full", full);
  EXPECT_EQ(error_of([&] { write_picture(full, picture_of(image)); }),
            full.string() + ": cannot be written: No space left on device");
}

TEST_P(EveryFormat, asks_for_every_row_once) {
  const test::Folder folder;
  std::vector<int> asked(100);
  Picture picture{5, 100, {}, {}, {}};
  picture.layers = {{"beauty", {"R", "G", "B"}, [&](int y, std::span<float> row) {
                       EXPECT_EQ(row.size(), 15U);
                       std::ranges::fill(row, 0.5F);
                       ++asked[std::size_t(y)];
                     }}};
  write_picture(folder / (std::string("a.") + GetParam()), picture);
  EXPECT_THAT(asked, testing::Each(1));
}
