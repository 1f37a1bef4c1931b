#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <string_view>

#include "image/decoders.h"

namespace airlight {
namespace {

/// Takes one word and the one blank behind it from the front of the text.
std::string_view take_word(std::string_view& text) {
  const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::size_t end = std::min(text.find_first_of(" \t\r\n", start), text.size());
  const std::string_view word = text.substr(start, end - start);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

template <class Number>
Number take_number(const Encoded& encoded, std::string_view& text) {
  const std::string_view word = take_word(text);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size())
    fail_to_decode(encoded, "its header is not \"PF width height scale\"");
  return number;
}

float swapped(float value) {
  return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
}

}  // namespace

Image decode_pfm(const Encoded& encoded) {
  std::string_view text(reinterpret_cast<const char*>(encoded.bytes.data()), encoded.bytes.size());
  const std::size_t channels = take_word(text) == "PF" ? 3 : 1;
  const int width = take_number<int>(encoded, text);
  const int height = take_number<int>(encoded, text);
  const bool little =
      take_number<float>(encoded, text) < 0;  // its size means nothing that files agree on
  check_size(encoded, width, height);
  const std::size_t row_bytes = std::size_t(width) * channels * sizeof(float);
  if (text.size() < row_bytes * std::size_t(height))
    fail_to_decode(encoded, "the file ends too early");

  const bool foreign = little != (std::endian::native == std::endian::little);
  Image image(width, height, 3);
  for (int y = height - 1; y >= 0; --y) {  // the format starts at the bottom
    const std::span<float> row = image.row(y);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t source = channels == 3 ? i : i / 3;
      std::memcpy(&row[i], text.data() + source * sizeof(float), sizeof(float));
    }
    if (foreign) std::ranges::transform(row, row.begin(), swapped);
    text.remove_prefix(row_bytes);
  }
  return image;
}

Image decode_pfm_numbers(const Encoded& encoded) {
  const Image three = decode_pfm(encoded);
  Image image(three.width, three.height, 1);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = three.pixels[3 * i];
  return image;
}

}  // namespace airlight
