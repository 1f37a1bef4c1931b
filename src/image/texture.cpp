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

}  // namespace

std::array<float, 4> Texture::sample(float u, float v) const {
  const Neighbours x = neighbours(u, width, wrap_u);
  const Neighbours y = neighbours(1 - v, height, wrap_v);
  std::array<float, 4> sum{};
  const auto add = [&](int column, int row, float weight) {
    const std::uint8_t* texel =
        rgba.data() + 4 * (std::size_t(row) * std::size_t(width) + std::size_t(column));
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += weight * (srgb ? linear_of_srgb[texel[c]] : float(texel[c]) / 255);
    sum[3] += weight * (float(texel[3]) / 255);
  };
  add(x.first, y.first, (1 - x.weight) * (1 - y.weight));
  add(x.second, y.first, x.weight * (1 - y.weight));
  add(x.first, y.second, (1 - x.weight) * y.weight);
  add(x.second, y.second, x.weight * y.weight);
  return sum;
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
