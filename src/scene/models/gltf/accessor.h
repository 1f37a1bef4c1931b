#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/affine.h"
#include "scene/models/gltf/document.h"

namespace airlight::gltf {

/// The elements that an accessor describes, read one by one: interleaved, normalised, sparse or
/// absent (zeros).
class Accessor {
 public:
  /// Checks that every element lies in its buffer. `where` is the accessor's user, such as
  /// "meshes[0].primitives[0].indices"; `type` the only TINYGLTF_TYPE_... accepted. Throws Error.
  Accessor(const Document& document, int index, int type, const std::string& where);

  std::size_t size() const { return size_; }

  /// Element i as numbers, the rest 0. Whole numbers are fractions of their range if the accessor
  /// says normalized.
  std::array<float, 4> floats(std::size_t i) const;

  /// Element i of an accessor of unsigned whole numbers.
  std::uint32_t integer(std::size_t i) const;

  /// Whether the components are unsigned whole numbers, as indices are.
  bool is_unsigned() const;

 private:
  /// Elements in memory, `stride` bytes apart; zeros if there is no memory.
  struct Elements {
    const std::byte* data = nullptr;
    std::size_t stride = 0;
    int component_type = 0;
    int components = 1;
    bool normalized = false;

    std::array<float, 4> floats(std::size_t i) const;
    std::uint32_t integer(std::size_t i) const;
  };

  Elements elements_;
  std::size_t size_ = 0;
  std::vector<std::array<float, 4>> decoded_;  ///< of a sparse accessor
  std::vector<std::uint32_t> decoded_integers_;
};

/// The first `count` matrices of an accessor. Throws Error if it has others, or fewer.
std::vector<Affine> read_matrices(const Document& document, int index, std::size_t count,
                                  const std::string& where);

}  // namespace airlight::gltf
