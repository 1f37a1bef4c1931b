#include "image/input.h"

#include "image/decoders.h"
#include "image/read_file.h"
#include "image/srgb.h"

namespace airlight {
namespace {

constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";

bool is_exr(const Encoded& encoded) { return encoded.starts_with(exr_magic); }
bool is_pfm(const Encoded& encoded) {
  return encoded.starts_with("PF") || encoded.starts_with("Pf");
}
bool is_hdr(const Encoded& encoded) { return encoded.starts_with("#?"); }

/// As it is to be seen: EXIF's orientations 5 to 8 exchange rows and columns, then 2, 3, 6 and 7
/// count from the right, 3, 4, 7 and 8 from below.
Image linear(const Codes& codes) {
  const int turn = codes.orientation;
  const bool exchanged = turn >= 5;
  const bool from_right = turn == 2 || turn == 3 || turn == 6 || turn == 7;
  const bool from_below = turn == 3 || turn == 4 || turn == 7 || turn == 8;
  Image image(exchanged ? codes.height : codes.width, exchanged ? codes.width : codes.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int right = from_right ? image.width - 1 - x : x;
      const int down = from_below ? image.height - 1 - y : y;
      const int column = exchanged ? down : right, row = exchanged ? right : down;
      const std::size_t pixel = std::size_t(row) * std::size_t(codes.width) + std::size_t(column);
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = linear_of_srgb[codes.rgba[4 * pixel + std::size_t(c)]];
    }
  return image;
}

Image image_of(const Encoded& encoded, const std::string& layer) {
  if (is_exr(encoded)) return decode_exr(encoded, layer);
  if (!layer.empty()) fail_to_decode(encoded, "only EXR files have a layer \"" + layer + "\"");
  if (is_pfm(encoded)) return decode_pfm(encoded);
  if (encoded.is_png()) return decode_png(encoded);
  if (is_hdr(encoded)) return decode_hdr(encoded);
  return linear(decode_codes(encoded, "PNG, JPEG, BMP, TGA, EXR, HDR, PFM"));
}

}  // namespace

Image read_image(const std::filesystem::path& path, const std::string& layer) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  return image_of({bytes, name}, layer);
}

std::optional<Image> read_radiance(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (!is_exr(encoded) && !is_pfm(encoded) && !is_hdr(encoded)) return std::nullopt;
  if (is_exr(encoded) && !exr_is_whole(encoded))
    fail_to_decode(encoded, "it is a crop of its picture; accepted: a whole one");
  return image_of(encoded, "");
}

Numbers read_numbers(const std::filesystem::path& path, const std::string& channel) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (is_exr(encoded)) return {decode_exr_channel(encoded, channel)};
  if (!channel.empty())
    fail_to_decode(encoded, "only EXR files have a channel \"" + channel + "\"");
  if (encoded.starts_with("Pf")) return {decode_pfm_numbers(encoded)};
  if (encoded.is_png()) return {decode_png_numbers(encoded), true};
  fail_to_decode(encoded, "it is no picture of numbers; accepted: EXR, PFM and PNG of one channel");
}

Picture read_picture(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (!is_exr(encoded)) fail_to_decode(encoded, "only EXR files have layers");
  return exr_picture(encoded);
}

std::map<std::string, std::string> read_metadata(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (is_exr(encoded)) return exr_metadata(encoded);
  if (encoded.is_png()) return png_metadata(encoded);
  return {};
}

}  // namespace airlight
