#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "image/picture.h"

namespace airlight {

/// Encoded bytes of a picture and the name that stands for them in errors. Every decoder throws
/// Error for bytes that are not such a picture, whatever they are, and for one beyond `max_pixels`.
struct Encoded {
  std::span<const std::byte> bytes;
  const std::string& name;

  bool starts_with(std::string_view magic) const;
  bool is_png() const;
};

/// "name: cannot be read: reason".
[[noreturn]] void fail_to_decode(const Encoded& encoded, const std::string& reason);

/// What a broken or hostile header may ask for: 2^27 pixels are 1.6 GB of RGB floats.
constexpr std::int64_t max_pixels = std::int64_t{1} << 27;

/// Throws unless both sizes are positive and the pixels few enough.
void check_size(const Encoded& encoded, std::int64_t width, std::int64_t height);

Image decode_exr(const Encoded& encoded, const std::string& layer);
Image decode_pfm(const Encoded& encoded);
Image decode_png(const Encoded& encoded);
Image decode_hdr(const Encoded& encoded);  ///< Radiance

/// Whether the file has all pixels of its picture, no crop of them.
bool exr_is_whole(const Encoded& encoded);

/// Of one channel, without any colour space; as `read_numbers`.
Image decode_exr_channel(const Encoded& encoded, const std::string& channel);
Image decode_pfm_numbers(const Encoded& encoded);
Image decode_png_numbers(const Encoded& encoded);

Picture exr_picture(const Encoded& encoded);

std::map<std::string, std::string> exr_metadata(const Encoded& encoded);
std::map<std::string, std::string> png_metadata(const Encoded& encoded);

/// 8 bit codes as they stand in the file: no colour space is applied.
struct Codes {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< four bytes a pixel, row 0 on top
  int orientation = 1;  ///< EXIF's: how who shows it turns or mirrors it, 1: not at all; up to 8
};

/// Any of the three below. `accepted` is what an error says that the caller takes.
Codes decode_codes(const Encoded& encoded, const std::string& accepted = "PNG, JPEG, BMP, TGA");
Codes png_codes(const Encoded& encoded);
Codes jpeg_codes(const Encoded& encoded);
Codes stb_codes(const Encoded& encoded, const std::string& accepted);  ///< BMP and TGA

}  // namespace airlight
