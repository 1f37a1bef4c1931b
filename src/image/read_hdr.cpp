// Radiance pictures: G. Ward, "Real Pixels", Graphics Gems II, 1991. stb_image reads them too, but
// a truncated file keeps its 2022 version busy for ever.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "image/decoders.h"

namespace airlight {
namespace {

/// The bytes not read yet.
class Source {
 public:
  explicit Source(const Encoded& encoded) : encoded_(encoded), rest_(encoded.bytes) {}

  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) fail_to_decode(encoded_, "the file ends too early");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  int byte() { return std::to_integer<int>(take(1)[0]); }

  std::string line() {
    std::string text;
    for (int c = byte(); c != '\n'; c = byte()) text.push_back(char(c));
    return text;
  }

  /// Whether the next bytes announce a run-length encoded row of this width.
  bool starts_runs(int width) const {
    if (width < 8 || width > 32767 || rest_.size() < 4) return false;
    const auto at = [&](std::size_t i) { return std::to_integer<int>(rest_[i]); };
    return at(0) == 2 && at(1) == 2 && at(2) * 256 + at(3) == width;
  }

 private:
  const Encoded& encoded_;
  std::span<const std::byte> rest_;
};

/// "-Y height +X width": rows from top to bottom, the only order that programs write.
bool read_size(std::string_view line, int& height, int& width) {
  const auto take = [&](std::string_view word, int& number) {
    if (!line.starts_with(word)) return false;
    line.remove_prefix(word.size());
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    line.remove_prefix(std::size_t(end - line.data()));
    return error == std::errc();
  };
  return take("-Y ", height) && take(" +X ", width) && line.empty();
}

/// One component of a row: runs of one value (count above 128) and of different ones.
void read_runs(const Encoded& encoded, Source& source, std::span<std::uint8_t> rgbe,
               std::size_t component) {
  for (std::size_t i = component; i < rgbe.size();) {
    const int code = source.byte();
    const int count = code > 128 ? code - 128 : code;
    if (count == 0 || std::size_t(count) > (rgbe.size() - i + 3) / 4)
      fail_to_decode(encoded, "a run of equal values does not fit its row");
    const auto values = source.take(code > 128 ? 1 : std::size_t(count));
    for (int k = 0; k < count; ++k, i += 4)
      rgbe[i] = std::to_integer<std::uint8_t>(values[code > 128 ? 0 : std::size_t(k)]);
  }
}

/// A row without components of their own: pixels, each 1, 1, 1, n of which says that the one before
/// comes n times more; such pixels in a row give n digit by digit, the lowest first.
void read_pixels(const Encoded& encoded, Source& source, std::span<std::uint8_t> rgbe) {
  int shift = 0;
  for (std::size_t i = 0; i < rgbe.size();) {
    const auto pixel = source.take(4);
    const auto code = [&](std::size_t c) { return std::to_integer<std::uint8_t>(pixel[c]); };
    if (code(0) != 1 || code(1) != 1 || code(2) != 1) {
      for (std::size_t c = 0; c < 4; ++c) rgbe[i++] = code(c);
      shift = 0;
      continue;
    }
    const std::size_t count = 4 * (std::size_t(code(3)) << shift);
    if (i == 0 || shift > 16 || count > rgbe.size() - i)
      fail_to_decode(encoded, "a run of equal values does not fit its row");
    for (const std::size_t end = i + count; i < end; ++i) rgbe[i] = rgbe[i - 4];
    shift += 8;
  }
}

/// The factors of a line such as "EXPOSURE=2", by which its writer multiplied all pixels: one for
/// all colours, or one for each.
std::array<double, 3> factors_of(const Encoded& encoded, std::string_view line, int count) {
  std::array<double, 3> factors{};
  std::string_view rest = line.substr(line.find('=') + 1);
  for (int i = 0; i < count; ++i) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    double& factor = factors[std::size_t(i)];
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), factor);
    if (error != std::errc() || !(factor > 0) || !std::isfinite(factor) ||
        !std::isfinite(1 / factor))
      fail_to_decode(encoded, fmt::format("it has {}; accepted: {} above 0", line,
                                          count == 1 ? "a number" : "three numbers"));
    rest.remove_prefix(std::size_t(end - rest.data()));
  }
  if (count == 1) factors.fill(factors[0]);
  return factors;
}

}  // namespace

Image decode_hdr(const Encoded& encoded) {
  Source source(encoded);
  std::array<double, 3> multiplied = {1, 1, 1};  // lines count all together
  const auto multiply = [&](std::string_view line, int count) {
    const std::array<double, 3> factors = factors_of(encoded, line, count);
    for (std::size_t c = 0; c < 3; ++c) multiplied[c] *= factors[c];
  };
  for (std::string line = source.line(); !line.empty(); line = source.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      fail_to_decode(encoded, "it has " + line + "; accepted: FORMAT=32-bit_rle_rgbe");
    if (line.starts_with("EXPOSURE=")) multiply(line, 1);
    if (line.starts_with("COLORCORR=")) multiply(line, 3);
  }
  int width = 0;
  int height = 0;
  if (!read_size(source.line(), height, width))
    fail_to_decode(encoded, "its size is not written as \"-Y height +X width\"");
  check_size(encoded, width, height);

  Image image(width, height, 3);
  std::vector<std::uint8_t> rgbe(std::size_t(width) * 4);
  for (int y = 0; y < height; ++y) {
    if (source.starts_runs(width)) {
      source.take(4);
      for (std::size_t component = 0; component < 4; ++component)
        read_runs(encoded, source, rgbe, component);
    } else {
      read_pixels(encoded, source, rgbe);
    }
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* pixel = &rgbe[std::size_t(x) * 4];
      for (int c = 0; c < 3;
           ++c)  // the common exponent is biased by 128, the mantissas count 1/256
        image.at(x, y, c) =
            pixel[3] == 0
                ? 0
                : float(std::ldexp(double(pixel[c]), pixel[3] - 136) / multiplied[std::size_t(c)]);
    }
  }
  return image;
}

}  // namespace airlight
