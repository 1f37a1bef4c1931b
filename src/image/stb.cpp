// Debian's stb_image for BMP and TGA, which have no library here. Its other decoders are left out:
// broken JPG and HDR files lead the version of 2022 out of its tables or into endless loops.
#include <climits>
#include <memory>

#include "image/decoders.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace airlight {

Codes stb_codes(const Encoded& encoded, const std::string& accepted) {
  if (encoded.bytes.size() > std::size_t{INT_MAX})
    fail_to_decode(encoded, "it is longer than 2 GiB");
  const auto* bytes = reinterpret_cast<const stbi_uc*>(encoded.bytes.data());
  const int size = int(encoded.bytes.size());
  int width = 0;
  int height = 0;
  int kept = 0;
  if (stbi_info_from_memory(bytes, size, &width, &height, &kept) == 0)
    fail_to_decode(encoded, std::string("it is no picture of a known format: ") +
                                stbi_failure_reason() + "; accepted: " + accepted);
  check_size(encoded, width, height);
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> first(
      stbi_load_from_memory(bytes, size, &width, &height, &kept, 4), stbi_image_free);
  if (first == nullptr) fail_to_decode(encoded, stbi_failure_reason());
  const std::size_t count = std::size_t(width) * std::size_t(height) * 4;
  return {width, height, {first.get(), first.get() + count}};
}

}  // namespace airlight
