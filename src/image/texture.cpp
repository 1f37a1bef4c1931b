#include "image/texture.h"

#include <cmath>

#include "image/decoders.h"
#include "image/read_file.h"
#include "image/srgb.h"

namespace airlight {
namespace {

/// The two texels of a row or column between whose centres x lies, and the weight of the second.
struct Neighbours {
  int first;
  int second;
  float weight;
};

int wrapped(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return i < 0 ? 0 : i < size ? i : size - 1;
  const int period = wrap == Wrap::mirror ? 2 * size : size;
  i = i < 0 ? i + period : i < period ? i : i - period;
  return i < size ? i : 2 * size - 1 - i;
}

/// x is a coordinate that counts 1 for the whole texture.
Neighbours neighbours(float x, int size, Wrap wrap) {
  if (!std::isfinite(x)) x = 0;
  if (wrap == Wrap::clamp)
    x = std::fmin(std::fmax(x, 0.0F), 1.0F);
  else if (!(x >= 0 && x < 1))  // seldom: std::floor is a call on machines of old
    x -= wrap == Wrap::repeat ? std::floor(x) : 2 * std::floor(x / 2);
  const float texel = x * float(size) - 0.5F;  // from -1/2 to the period - 1/2
  const int i = texel < 0 ? -1 : int(texel);
  return {wrapped(i, size, wrap), wrapped(i + 1, size, wrap), texel - float(i)};
}

/// A channel of a texel as a number; channel 3 is A.
float value(const Texture& texture, const std::uint8_t* texel, std::size_t channel) {
  const std::uint8_t code = texel[channel];
  return texture.srgb && channel < 3 ? linear_of_srgb[code] : float(code) / 255;
}

/// The mean of four texels about a point; add(sum, texel, weight) adds one of them.
template <class Sum, class Add>
Sum bilinear(const Texture& texture, float u, float v, Add&& add) {
  const Neighbours x = neighbours(u, texture.width, texture.wrap_u);
  const Neighbours y = neighbours(1 - v, texture.height, texture.wrap_v);
  Sum sum{};
  const auto texel = [&](int column, int row, float weight) {
    const std::size_t index = std::size_t(row) * std::size_t(texture.width) + std::size_t(column);
    add(sum, texture.rgba.data() + 4 * index, weight);
  };
  texel(x.first, y.first, (1 - x.weight) * (1 - y.weight));
  texel(x.second, y.first, x.weight * (1 - y.weight));
  texel(x.first, y.second, (1 - x.weight) * y.weight);
  texel(x.second, y.second, x.weight * y.weight);
  return sum;
}

}  // namespace

std::array<float, 4> Texture::sample(float u, float v) const {
  const auto add = [&](std::array<float, 4>& sum, const std::uint8_t* texel, float weight) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * value(*this, texel, c);
  };
  return bilinear<std::array<float, 4>>(*this, u, v, add);
}

float Texture::sample(float u, float v, std::size_t channel) const {
  const auto add = [&](float& sum, const std::uint8_t* texel, float weight) {
    sum += weight * value(*this, texel, channel);
  };
  return bilinear<float>(*this, u, v, add);
}

std::array<float, 3> Texture::over_black(float u, float v) const {
  const auto add = [&](std::array<float, 3>& sum, const std::uint8_t* texel, float weight) {
    const float covers = weight * value(*this, texel, 3);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += covers * value(*this, texel, c);
  };
  return bilinear<std::array<float, 3>>(*this, u, v, add);
}

Texture load_texture(const std::filesystem::path& path) {
  return decode_texture(read_file(path), path.string());
}

Texture decode_texture(std::span<const std::byte> encoded, const std::string& name) {
  Codes codes = decode_codes({encoded, name});
  Texture texture;
  texture.width = codes.width;
  texture.height = codes.height;
  texture.rgba = std::move(codes.rgba);
  return texture;
}

}  // namespace airlight
