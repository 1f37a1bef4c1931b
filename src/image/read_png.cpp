#include <png.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "image/decoders.h"
#include "image/srgb.h"

namespace airlight {
namespace {

/// Bytes that libpng reads one after the other.
struct Source {
  std::span<const std::byte> rest;
  std::string error;
};

void on_read(png_structp png, png_bytep out, std::size_t size) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "the file ends too early");
  std::memcpy(out, source.rest.data(), size);
  source.rest = source.rest.subspan(size);
}

void on_error(png_structp png, png_const_charp message) {
  static_cast<Source*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// libpng's own state for reading headers.
struct Decoder {
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Decoder(Source& source) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) {
      png_destroy_read_struct(&png, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png, &source, on_read);
  }
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// False where libpng gave up; the source knows why.
  bool read_info() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    return true;
  }

  /// Rows of 16 bit codes in the machine's order, of a grey picture; after `read_info`.
  bool read_grey(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_expand_16(png);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_image(png, rows);
    return true;
  }

  /// Rows of 16 bit RGBA in the machine's order, whatever the file has; after `read_info`.
  bool read_wide(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 65535, PNG_FILLER_AFTER);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_image(png, rows);
    return true;
  }

  /// Rows of 8 bit RGBA, whatever the file has; after `read_info`.
  bool read_rgba(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_image(png, rows);
    return true;
  }
};

/// Width and height of a picture of which nothing has been read yet.
std::pair<png_uint_32, png_uint_32> read_header(const Encoded& encoded, const Source& source,
                                                Decoder& decoder) {
  if (!decoder.read_info()) fail_to_decode(encoded, source.error);
  const auto width = png_get_image_width(decoder.png, decoder.info);
  const auto height = png_get_image_height(decoder.png, decoder.info);
  check_size(encoded, width, height);
  return {width, height};
}

/// Linear light of every 16 bit code: by sRGB's curve, unless the file tells a gamma that is not
/// near it.
std::vector<float> linear_of_wide(const Decoder& decoder) {
  double gamma = 0;
  const bool other = png_get_valid(decoder.png, decoder.info, PNG_INFO_sRGB) == 0 &&
                     png_get_gAMA(decoder.png, decoder.info, &gamma) != 0 &&
                     std::abs(gamma * 2.2 - 1) > 0.05;
  std::vector<float> table(65536);
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double c = double(code) / 65535;
    table[code] = float(other ? std::pow(c, 1 / gamma) : linear_of_code(c));
  }
  return table;
}

/// Where libpng shall write each row of so many codes.
template <class Code>
std::vector<png_bytep> rows_of(std::vector<Code>& codes, std::size_t codes_a_row) {
  std::vector<png_bytep> rows;
  for (std::size_t i = 0; i < codes.size(); i += codes_a_row)
    rows.push_back(reinterpret_cast<png_bytep>(codes.data() + i));
  return rows;
}

}  // namespace

/// By way of 16 bit codes, whatever the file has: libpng's own way to linear light takes sRGB for a
/// power, which leaves a quarter of what is dark, and rounds what it has laid over black to codes.
Image decode_png(const Encoded& encoded) {
  Source source{encoded.bytes, ""};
  Decoder decoder(source);
  const auto [width, height] = read_header(encoded, source, decoder);
  std::vector<std::uint16_t> codes(std::size_t(width) * height * 4);
  std::vector<png_bytep> rows = rows_of(codes, 4 * std::size_t(width));
  const std::vector<float> linear = linear_of_wide(decoder);
  if (!decoder.read_wide(rows.data())) fail_to_decode(encoded, source.error);
  Image image(int(width), int(height), 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t pixel = i / 3 * 4;
    image.pixels[i] = linear[codes[pixel + i % 3]] * (float(codes[pixel + 3]) / 65535.0F);
  }
  return image;
}

Codes png_codes(const Encoded& encoded) {
  Source source{encoded.bytes, ""};
  Decoder decoder(source);
  const auto [width, height] = read_header(encoded, source, decoder);
  Codes codes{int(width), int(height), {}};
  codes.rgba.resize(std::size_t(width) * height * 4);
  std::vector<png_bytep> rows = rows_of(codes.rgba, 4 * std::size_t(width));
  if (!decoder.read_rgba(rows.data())) fail_to_decode(encoded, source.error);
  return codes;
}

Image decode_png_numbers(const Encoded& encoded) {
  Source source{encoded.bytes, ""};
  Decoder decoder(source);
  const auto [width, height] = read_header(encoded, source, decoder);
  if (png_get_color_type(decoder.png, decoder.info) != PNG_COLOR_TYPE_GRAY)
    fail_to_decode(encoded, "it has colours; accepted: a grey PNG without alpha");
  // Libpng would write these as alpha, in rows twice as long.
  if (png_get_valid(decoder.png, decoder.info, PNG_INFO_tRNS) != 0)
    fail_to_decode(encoded, "it has a transparent grey; accepted: a grey PNG without alpha");
  std::vector<std::uint16_t> codes(std::size_t(width) * height);
  std::vector<png_bytep> rows = rows_of(codes, width);
  // Libpng spreads fewer bits over all 16.
  const int bits = png_get_bit_depth(decoder.png, decoder.info);
  if (!decoder.read_grey(rows.data())) fail_to_decode(encoded, source.error);
  const int spread = 65535 / ((1 << bits) - 1);
  Image image(int(width), int(height), 1);
  for (std::size_t i = 0; i < codes.size(); ++i) image.pixels[i] = float(codes[i] / spread);
  return image;
}

std::map<std::string, std::string> png_metadata(const Encoded& encoded) {
  Source source{encoded.bytes, ""};
  Decoder decoder(source);
  if (!decoder.read_info()) fail_to_decode(encoded, source.error);
  png_textp chunks = nullptr;
  const int count = png_get_text(decoder.png, decoder.info, &chunks, nullptr);
  std::map<std::string, std::string> metadata;
  for (const png_text& chunk : std::span(chunks, std::size_t(count)))
    metadata[chunk.key] = chunk.text;
  return metadata;
}

}  // namespace airlight
