#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace airlight {

/// What lies beyond the edge of a texture.
enum class Wrap {
  repeat,
  clamp,   ///< the edge texel goes on
  mirror,  ///< repeats, every other copy mirrored
};

/// An 8 bit image on a surface, one texel or more.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< row 0 on top, four bytes a texel
  bool srgb = true;  ///< R, G, B are sRGB codes (else linear / 255); A is always linear
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;

  /// Linear R, G, B, A in [0, 1], bilinear between texel centres, which are at (i + 1/2) / size.
  /// u goes right, v up: v = 0 is the lower edge, as in OBJ (glTF counts v downwards: pass 1 - v).
  /// Coordinates that are not finite count as 0.
  std::array<float, 4> sample(float u, float v) const;

  /// One channel of the same, 0 to 3, at a quarter of the cost.
  float sample(float u, float v, std::size_t channel) const;

  /// The same of the texture laid on black: every texel's colour counts as far as it is opaque, so
  /// that what hides in transparent texels shows nowhere.
  std::array<float, 3> over_black(float u, float v) const;
};

/// Reads a PNG, JPG, BMP or TGA file. Throws Error if it cannot be read or is no such picture.
Texture load_texture(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in errors.
Texture decode_texture(std::span<const std::byte> encoded, const std::string& name);

}  // namespace airlight
