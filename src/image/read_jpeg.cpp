#include <cstdio>  // jpeglib.h wants it first

#include <jerror.h>
#include <jpeglib.h>
#include <csetjmp>
#include <string_view>

#include "image/decoders.h"

namespace airlight {
namespace {

/// What the first directory of EXIF data says of the picture's orientation; 1 if it says nothing.
int exif_orientation(std::string_view tiff) {
  const bool little = tiff.starts_with("II");
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::size_t value = 0;
    if (at > tiff.size() || bytes > tiff.size() - at) return value;
    for (std::size_t i = 0; i < bytes; ++i)
      value = value << 8 | static_cast<unsigned char>(tiff[little ? at + bytes - 1 - i : at + i]);
    return value;
  };
  const std::size_t directory = number(4, 4), entries = number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (number(entry, 2) != 0x112) continue;
    const std::size_t orientation = number(entry + 8, 2);
    return orientation >= 1 && orientation <= 8 ? int(orientation) : 1;
  }
  return 1;
}

/// libjpeg's state. Its errors are long jumps; nothing that they leave needs a destructor.
class Decoder {
 public:
  explicit Decoder(const Encoded& encoded) : encoded_(encoded) {
    state_.err = jpeg_std_error(&errors_);
    state_.client_data = this;
    errors_.error_exit = on_error;
    errors_.emit_message = on_message;
    jpeg_create_decompress(&state_);
  }
  ~Decoder() { jpeg_destroy_decompress(&state_); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  Codes read() {
    run([&] {
      jpeg_mem_src(&state_, reinterpret_cast<const unsigned char*>(encoded_.bytes.data()),
                   encoded_.bytes.size());
      jpeg_save_markers(&state_, JPEG_APP0 + 1, 0xFFFF);
      jpeg_read_header(&state_, TRUE);
    });
    check_size(encoded_, state_.image_width, state_.image_height);
    Codes codes{int(state_.image_width), int(state_.image_height), {}};
    const std::size_t row_bytes = std::size_t(codes.width) * 4;
    codes.rgba.resize(row_bytes * std::size_t(codes.height));
    codes.orientation = orientation();
    const bool inks = state_.jpeg_color_space == JCS_CMYK || state_.jpeg_color_space == JCS_YCCK;
    run([&] {
      state_.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
      jpeg_start_decompress(&state_);
      while (state_.output_scanline < state_.output_height) {
        JSAMPROW row = codes.rgba.data() + state_.output_scanline * row_bytes;
        jpeg_read_scanlines(&state_, &row, 1);
      }
      jpeg_finish_decompress(&state_);
    });
    if (inks) mix_inks(codes.rgba);
    return codes;
  }

 private:
  template <class Calls>
  void run(Calls&& calls) {
    if (setjmp(escape_) != 0) fail_to_decode(encoded_, message_);
    calls();
  }

  /// From the first EXIF data there are; 1 without any.
  int orientation() const {
    for (const auto* marker = state_.marker_list; marker != nullptr; marker = marker->next) {
      const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
      constexpr std::string_view mark("Exif\0\0", 6);
      if (data.starts_with(mark)) return exif_orientation(data.substr(mark.size()));
    }
    return 1;
  }

  /// Cyan, magenta, yellow and black become light, by a plain product. Programs that mark their
  /// files as Adobe's write how much light each ink leaves, others how much ink there is.
  void mix_inks(std::vector<std::uint8_t>& codes) const {
    const int turn = state_.saw_Adobe_marker ? 0 : 255;
    for (std::size_t i = 0; i < codes.size(); i += 4) {
      const int black = codes[i + 3] ^ turn;
      for (std::size_t c = i; c < i + 3; ++c)
        codes[c] = std::uint8_t(((codes[c] ^ turn) * black + 127) / 255);
      codes[i + 3] = 255;
    }
  }

  static void on_error(j_common_ptr state) {
    auto& decoder = *static_cast<Decoder*>(state->client_data);
    state->err->format_message(state, decoder.message_);
    std::longjmp(decoder.escape_, 1);
  }

  /// Warnings are let pass, but for a file that ends too early: libjpeg would fill up with grey.
  static void on_message(j_common_ptr state, int level) {
    if (level < 0 && state->err->msg_code == JWRN_JPEG_EOF) on_error(state);
  }

  const Encoded& encoded_;
  jpeg_decompress_struct state_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf escape_{};
  char message_[JMSG_LENGTH_MAX] = "";
};

}  // namespace

Codes jpeg_codes(const Encoded& encoded) { return Decoder(encoded).read(); }

}  // namespace airlight
