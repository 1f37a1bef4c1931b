#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "error.h"
#include "image/atomic_file.h"
#include "image/output.h"
#include "image/srgb.h"

namespace airlight {
namespace {

std::string text_of(const MetadataValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// libpng with its long jumps turned into exceptions, and exceptions of the file carried past its
/// frames.
class Encoder {
 public:
  Encoder(AtomicFile& file, const std::filesystem::path& path) : file_(file), path_(path) {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, this, on_write, on_flush);
  }
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Runs `calls(png, info)`, plain calls to libpng that a long jump may leave: nothing in it needs
  /// a destructor.
  template <class Calls>
  void operator()(Calls&& calls) {
    if (setjmp(png_jmpbuf(png_)) != 0) std::rethrow_exception(failure_);
    calls(png_, info_);
  }

 private:
  static Encoder& self(png_structp png) { return *static_cast<Encoder*>(png_get_error_ptr(png)); }

  static void on_error(png_structp png, png_const_charp message) {
    Encoder& encoder = self(png);
    if (!encoder.failure_)
      encoder.failure_ = std::make_exception_ptr(
          Error(fmt::format("{}: cannot be written: {}", encoder.path_.string(), message)));
    png_longjmp(png, 1);
  }

  static void on_warning(png_structp, png_const_charp) {}

  static void on_write(png_structp png, png_bytep bytes, std::size_t size) {
    Encoder& encoder = self(png);
    try {
      encoder.file_.write(std::as_bytes(std::span(bytes, size)));
      return;
    } catch (...) {
      encoder.failure_ = std::current_exception();
    }
    png_longjmp(png, 1);
  }

  static void on_flush(png_structp) {}

  AtomicFile& file_;
  const std::filesystem::path& path_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::exception_ptr failure_;
};

void write_text_chunks(Encoder& encoder, const Picture& picture) {
  for (const auto& [key, value] : picture.metadata) {
    std::string text = text_of(value);
    const bool ascii = std::ranges::all_of(text, [](unsigned char c) { return c < 128; });
    png_text chunk{};
    chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(key.c_str());  // libpng only copies it
    chunk.text = text.data();
    encoder([&](png_structp png, png_infop info) { png_set_text(png, info, &chunk, 1); });
  }
}

/// The codes of a row: R, G, B and, if there is alpha, A.
class Codes {
 public:
  Codes(const Picture& picture, const Display& display, const std::filesystem::path& path)
      : picture_(picture),
        display_(display),
        path_(path),
        light_(std::size_t(picture.width) * 3),
        alpha_(picture.alpha ? std::size_t(picture.width) : 0),
        codes_(light_.size() + alpha_.size()) {}

  const std::uint8_t* row(int y) {
    fill_row(picture_.layers.front(), y, light_, path_);
    for (float& light : light_) light = displayed(light, display_);
    if (!picture_.alpha) {
      std::ranges::transform(light_, codes_.begin(), srgb_of_linear);
      return codes_.data();
    }
    fill_row(*picture_.alpha, y, alpha_, path_);
    for (std::size_t x = 0; x < alpha_.size(); ++x) {
      const float* light = &light_[3 * x];
      const float brightest = std::max({light[0], light[1], light[2]});
      // Rounded up, so that the little light of a faint alpha fits, too.
      const float alpha = std::clamp(
          std::max(std::round(255 * alpha_[x]), std::ceil(255 * brightest)), 0.0F, 255.0F);
      for (int c = 0; c < 3; ++c)
        codes_[4 * x + std::size_t(c)] = alpha > 0 ? srgb_of_linear(light[c] * 255 / alpha) : 0;
      codes_[4 * x + 3] = std::uint8_t(alpha);
    }
    return codes_.data();
  }

 private:
  const Picture& picture_;
  const Display& display_;
  const std::filesystem::path& path_;
  std::vector<float> light_, alpha_;
  std::vector<std::uint8_t> codes_;
};

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture, const Display& display) {
  AtomicFile file(path);
  Encoder encoder(file, path);
  const auto width = png_uint_32(picture.width);
  const auto height = png_uint_32(picture.height);
  encoder([&](png_structp png, png_infop info) {
    png_set_IHDR(png, info, width, height, 8,
                 picture.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, 4);  // as small as libpng's 6, twice as fast
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  });
  write_text_chunks(encoder, picture);
  encoder([](png_structp png, png_infop info) { png_write_info(png, info); });

  Codes codes(picture, display, path);
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* row = codes.row(y);
    encoder([&](png_structp png, png_infop) { png_write_row(png, row); });
  }
  encoder([](png_structp png, png_infop info) { png_write_end(png, info); });
  file.commit();
}

}  // namespace airlight
