// Debian's stb_image for the formats that have no library here. Its functions stay in this file.
#include <climits>
#include <memory>

#include "image/decoders.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace airlight {

Codes decode_codes(const Encoded& encoded, int channels) {
  if (encoded.bytes.size() > std::size_t{INT_MAX})
    fail_to_decode(encoded, "it is longer than 2 GiB");
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.bytes.data());
  const int size = int(encoded.bytes.size());
  int width = 0;
  int height = 0;
  int kept = 0;
  if (stbi_info_from_memory(bytes, size, &width, &height, &kept) == 0)
    fail_to_decode(encoded,
                   std::string("it is no picture of a known format: ") + stbi_failure_reason());
  check_size(encoded, width, height);
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> first(
      stbi_load_from_memory(bytes, size, &width, &height, &kept, channels), stbi_image_free);
  if (first == nullptr) fail_to_decode(encoded, stbi_failure_reason());
  const std::size_t count = std::size_t(width) * std::size_t(height) * std::size_t(channels);
  return {width, height, {first.get(), first.get() + count}};
}

}  // namespace airlight
