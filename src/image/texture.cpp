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
  else if (wrap == Wrap::repeat)
    x -= std::floor(x);
  else
    x -= 2 * std::floor(x / 2);
  const float texel = x * float(size) - 0.5F;  // from -1/2 to the period - 1/2
  const float below = std::floor(texel);
  const int i = int(below);
  return {wrapped(i, size, wrap), wrapped(i + 1, size, wrap), texel - below};
}

float linear(const Texture& texture, std::uint8_t code) {
  return texture.srgb ? linear_of_srgb[code] : float(code) / 255;
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
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * linear(*this, texel[c]);
    sum[3] += weight * (float(texel[3]) / 255);
  };
  return bilinear<std::array<float, 4>>(*this, u, v, add);
}

std::array<float, 3> Texture::over_black(float u, float v) const {
  const auto add = [&](std::array<float, 3>& sum, const std::uint8_t* texel, float weight) {
    const float covers = weight * (float(texel[3]) / 255);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += covers * linear(*this, texel[c]);
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
