#include "scene/models/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "error.h"

namespace airlight::gltf {
namespace {

constexpr std::size_t most_zeros = std::size_t{1} << 24;  ///< elements of an accessor without bytes

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// A component as glTF 2.0 section 3.11 (normalised) and 3.6.2 read it.
float component(const std::byte* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const float x = load<std::int8_t>(at);
      return normalized ? std::max(x / 127, -1.0F) : x;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const float x = load<std::uint8_t>(at);
      return normalized ? x / 255 : x;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const float x = load<std::int16_t>(at);
      return normalized ? std::max(x / 32767, -1.0F) : x;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const float x = load<std::uint16_t>(at);
      return normalized ? x / 65535 : x;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return float(load<std::uint32_t>(at));
    default:
      return load<float>(at);
  }
}

/// The bytes where `count` elements of `size` bytes start, `stride` apart, `offset` into a buffer
/// view.
const std::byte* locate(const Document& document, int buffer_view, std::size_t offset,
                        std::size_t count, std::size_t size, std::size_t stride,
                        const std::string& where) {
  const auto bytes = document.view(buffer_view, where);
  // The checked document keeps numbers below 2^53, so only the product can overflow.
  std::size_t end = 0;
  const bool overflow = __builtin_mul_overflow(count - 1, stride, &end);
  if (overflow || end > bytes.size() || offset > bytes.size() || end + offset + size > bytes.size())
    throw Error(
        fmt::format("{}: {}: {} elements of {} bytes from byte {} on; bufferViews[{}] has {} bytes",
                    document.file, where, count, size, offset, buffer_view, bytes.size()));
  return bytes.data() + offset;
}

const char* name_of(int type) {
  return type == TINYGLTF_TYPE_SCALAR ? "SCALAR"
         : type == TINYGLTF_TYPE_VEC2 ? "VEC2"
         : type == TINYGLTF_TYPE_VEC3 ? "VEC3"
                                      : "VEC4";
}

}  // namespace

std::array<float, 4> Accessor::Elements::floats(std::size_t i) const {
  std::array<float, 4> values{};
  if (data == nullptr) return values;
  const std::byte* at = data + i * stride;
  const int size = tinygltf::GetComponentSizeInBytes(std::uint32_t(component_type));
  for (int c = 0; c < components; ++c)
    values[std::size_t(c)] = component(at + c * size, component_type, normalized);
  return values;
}

std::uint32_t Accessor::Elements::integer(std::size_t i) const {
  if (data == nullptr) return 0;
  const std::byte* at = data + i * stride;
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

Accessor::Accessor(const Document& document, int index, int type, const std::string& where) {
  const tinygltf::Accessor& accessor = document.model.accessors[std::size_t(index)];
  if (accessor.type != type)
    throw Error(fmt::format("{}: {}: accessors[{}] has elements of another type; {}", document.file,
                            where, index, name_of(type)));
  const int components = tinygltf::GetNumComponentsInType(std::uint32_t(type));
  const auto size = std::size_t(
      components * tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
  size_ = accessor.count;
  elements_ = {nullptr, size, accessor.componentType, components, accessor.normalized};
  if (accessor.bufferView >= 0) {
    const std::size_t stride =
        document.model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
    if (stride > 0) elements_.stride = stride;
    elements_.data = locate(document, accessor.bufferView, accessor.byteOffset, size_, size,
                            elements_.stride, where);
  } else if (size_ > most_zeros) {
    throw Error(
        fmt::format("{}: {}: accessors[{}] counts {} elements and has no bufferView; at most {}",
                    document.file, where, index, size_, most_zeros));
  }
  if (!accessor.sparse.isSparse) return;

  // What differs is given apart: where, and what.
  const auto& sparse = accessor.sparse;
  const auto count = std::size_t(sparse.count);
  Elements places{nullptr, 0, sparse.indices.componentType, 1, false};
  places.stride =
      std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(sparse.indices.componentType)));
  places.data = locate(document, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset),
                       count, places.stride, places.stride, where + ".sparse.indices");
  Elements values = elements_;
  values.stride = size;
  values.data = locate(document, sparse.values.bufferView, std::size_t(sparse.values.byteOffset),
                       count, size, size, where + ".sparse.values");
  decoded_.resize(size_);
  decoded_integers_.resize(is_unsigned() ? size_ : 0);
  for (std::size_t i = 0; i < size_; ++i) decoded_[i] = elements_.floats(i);
  for (std::size_t i = 0; i < decoded_integers_.size(); ++i)
    decoded_integers_[i] = elements_.integer(i);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t place = places.integer(i);
    if (place >= size_)
      throw Error(fmt::format("{}: {}.sparse.indices: {}; an index below {}", document.file, where,
                              place, size_));
    decoded_[place] = values.floats(i);
    if (is_unsigned()) decoded_integers_[place] = values.integer(i);
  }
}

bool Accessor::is_unsigned() const {
  return elements_.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         elements_.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         elements_.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::array<float, 4> Accessor::floats(std::size_t i) const {
  return decoded_.empty() ? elements_.floats(i) : decoded_[i];
}

std::uint32_t Accessor::integer(std::size_t i) const {
  return decoded_integers_.empty() ? elements_.integer(i) : decoded_integers_[i];
}

std::vector<Affine> read_matrices(const Document& document, int index, std::size_t count,
                                  const std::string& where) {
  const tinygltf::Accessor& accessor = document.model.accessors[std::size_t(index)];
  const auto fail = [&](const std::string& reason) {
    throw Error(fmt::format("{}: {}: accessors[{}] {}", document.file, where, index, reason));
  };
  if (accessor.type != TINYGLTF_TYPE_MAT4 ||
      accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    fail("has elements of another type; MAT4 of floats");
  if (accessor.bufferView < 0 || accessor.sparse.isSparse) fail("is sparse; all matrices");
  if (accessor.count < count) fail(fmt::format("has {} matrices; {}", accessor.count, count));
  constexpr std::size_t size = 16 * sizeof(float);
  const std::size_t told = document.model.bufferViews[std::size_t(accessor.bufferView)].byteStride;
  const std::size_t stride = told > 0 ? told : size;
  std::vector<Affine> matrices;
  if (count == 0) return matrices;
  const std::byte* at =
      locate(document, accessor.bufferView, accessor.byteOffset, count, size, stride, where);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Vec3<double>, 4> columns;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::byte* column = at + i * stride + 4 * c * sizeof(float);
      columns[c] = Vec3<double>(load<float>(column), load<float>(column + sizeof(float)),
                                load<float>(column + 2 * sizeof(float)));
    }
    matrices.push_back({columns[0], columns[1], columns[2], columns[3]});
  }
  return matrices;
}

}  // namespace airlight::gltf
