#include "image/input.h"

#include "image/decoders.h"
#include "image/read_file.h"
#include "image/srgb.h"

namespace airlight {
namespace {

constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";

Image linear(const Codes& codes) {
  Image image(codes.width, codes.height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = linear_of_srgb[codes.rgba[i / 3 * 4 + i % 3]];
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
  if (encoded.is_png()) return decode_png(encoded);
  if (encoded.starts_with("#?")) return decode_hdr(encoded);
  return linear(decode_codes(encoded));
}

std::map<std::string, std::string> read_metadata(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string name = path.string();
  const Encoded encoded{bytes, name};
  if (encoded.starts_with(exr_magic)) return exr_metadata(encoded);
  if (encoded.is_png()) return png_metadata(encoded);
  return {};
}

}  // namespace airlight
