#include "image/input.h"

#include <algorithm>

#include "image/decoders.h"
#include "image/read_file.h"
#include "image/srgb.h"

namespace airlight {
namespace {

constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";
constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

Image linear(const Codes& codes) {
  Image image(codes.width, codes.height, 3);
  std::ranges::transform(codes.values, image.pixels.begin(),
                         [](std::uint8_t code) { return linear_of_srgb[code]; });
  return image;
}

}  // namespace

Image read_image(const std::filesystem::path& path, const std::string& layer) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (encoded.starts_with(exr_magic)) return decode_exr(encoded, layer);
  if (!layer.empty()) fail_to_decode(encoded, "only EXR files have a layer \"" + layer + "\"");
  if (encoded.starts_with("PF") || encoded.starts_with("Pf")) return decode_pfm(encoded);
  if (encoded.starts_with(png_magic)) return decode_png(encoded);
  if (encoded.starts_with("#?")) return decode_hdr(encoded);
  return linear(decode_codes(encoded, 3));
}

std::map<std::string, std::string> read_metadata(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (encoded.starts_with(exr_magic)) return exr_metadata(encoded);
  if (encoded.starts_with(png_magic)) return png_metadata(encoded);
  return {};
}

}  // namespace airlight
