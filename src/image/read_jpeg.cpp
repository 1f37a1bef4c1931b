#include <cstdio>  // jpeglib.h wants it first

#include <jerror.h>
#include <jpeglib.h>
#include <csetjmp>

#include "image/decoders.h"

namespace airlight {
namespace {

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
      jpeg_read_header(&state_, TRUE);
    });
    check_size(encoded_, state_.image_width, state_.image_height);
    Codes codes{int(state_.image_width), int(state_.image_height), {}};
    const std::size_t row_bytes = std::size_t(codes.width) * 4;
    codes.rgba.resize(row_bytes * std::size_t(codes.height));
    run([&] {
      state_.out_color_space = JCS_EXT_RGBA;
      jpeg_start_decompress(&state_);
      while (state_.output_scanline < state_.output_height) {
        JSAMPROW row = codes.rgba.data() + state_.output_scanline * row_bytes;
        jpeg_read_scanlines(&state_, &row, 1);
      }
      jpeg_finish_decompress(&state_);
    });
    return codes;
  }

 private:
  template <class Calls>
  void run(Calls&& calls) {
    if (setjmp(escape_) != 0) fail_to_decode(encoded_, message_);
    calls();
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
