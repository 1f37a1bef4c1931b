#include "image/decoders.h"

#include <fmt/format.h>

#include <cstring>

#include "error.h"

namespace airlight {

bool Encoded::starts_with(std::string_view magic) const {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

bool Encoded::is_png() const { return starts_with("\x89PNG\r\n\x1a\n"); }

void fail_to_decode(const Encoded& encoded, const std::string& reason) {
  throw Error(fmt::format("{}: cannot be read: {}", encoded.name, reason));
}

void check_size(const Encoded& encoded, std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0 || width > max_pixels || height > max_pixels / width)
    fail_to_decode(encoded, fmt::format("it is {} x {} pixels; accepted: 1 to {} pixels in all",
                                        width, height, max_pixels));
}

Codes decode_codes(const Encoded& encoded, const std::string& accepted) {
  if (encoded.is_png()) return png_codes(encoded);
  if (encoded.starts_with("\xff\xd8")) return jpeg_codes(encoded);
  return stb_codes(encoded, accepted);
}

}  // namespace airlight
