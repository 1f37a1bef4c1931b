#include "scene/models/gltf/bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "error.h"
#include "image/read_file.h"

namespace airlight::gltf {
namespace {

constexpr std::uint32_t magic = 0x46546C67;       // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN"

/// A little-endian number.
std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t(bytes[offset + i]) << (8 * i);
  return word;
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The value of a base64 digit, 64 if it is none; both alphabets of RFC 4648.
constexpr std::array<std::uint8_t, 256> base64_digits = [] {
  std::array<std::uint8_t, 256> table{};
  table.fill(64);
  const std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    table[static_cast<unsigned char>(digits[i])] = std::uint8_t(i);
  table['-'] = 62, table['_'] = 63;
  return table;
}();

std::vector<std::byte> decode_base64(std::string_view text, const std::string& where) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::uint8_t digit = base64_digits[static_cast<unsigned char>(c)];
    if (digit == 64)
      throw Error(fmt::format("{}: a data URI with a character that is not base64", where));
    bits = bits << 6 | digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(std::byte(bits >> count & 255));
  }
  return bytes;
}

/// Replaces %20 and the like by what they stand for.
std::string decode_percent(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      text += char(code);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace

Chunks split_chunks(std::span<const std::byte> file, const std::string& name) {
  if (file.size() < 4 || word_at(file, 0) != magic) return {as_text(file), {}};
  const auto cut_off = [&](std::uint64_t wanted) {
    return Error(fmt::format("{}: it ends after {} of {} bytes; a whole .glb file", name,
                             file.size(), wanted));
  };
  if (file.size() < 20) throw cut_off(20);
  if (word_at(file, 4) != 2)
    throw Error(fmt::format("{}: binary glTF of version {}; version 2", name, word_at(file, 4)));
  if (word_at(file, 8) > file.size()) throw cut_off(word_at(file, 8));
  file = file.first(std::max(word_at(file, 8), std::uint32_t{20}));
  Chunks chunks;
  std::uint64_t at = 12;
  for (bool first = true; at + 8 <= file.size(); first = false) {
    const std::uint64_t length = word_at(file, at), end = at + 8 + length;
    if (end > file.size()) throw cut_off(end);
    const auto content = file.subspan(at + 8, length);
    const std::uint32_t type = word_at(file, at + 4);
    if (first != (type == json_chunk))
      throw Error(fmt::format("{}: its chunks are out of order; JSON first, and once", name));
    if (first) chunks.json = as_text(content);
    if (type == bin_chunk && chunks.binary.empty()) chunks.binary = content;
    at = end;
  }
  return chunks;
}

std::vector<std::byte> read_uri(const std::string& uri, const std::filesystem::path& folder,
                                const std::string& where) {
  if (uri.starts_with("data:")) {
    const std::string_view mark = ";base64,";
    const std::size_t found = uri.find(mark);
    if (found == uri.npos)
      throw Error(fmt::format("{}: a data URI that is not base64; \"data:...;base64,...\"", where));
    return decode_base64(std::string_view(uri).substr(found + mark.size()), where);
  }
  if (uri.find("://") != uri.npos)
    throw Error(fmt::format("{}: \"{}\" is not in a file; a path relative to the model, or data",
                            where, uri));
  const std::string path = decode_percent(uri);
  if (path.empty() || path.find('\0') != path.npos)
    throw Error(fmt::format("{}: it names no file", where));
  try {
    return read_file(folder / path);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", where, error.what()));
  }
}

Buffers::Buffers(const Json& document, std::span<const std::byte> binary,
                 const std::filesystem::path& folder, const std::string& file) {
  const auto list = document.find("buffers");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i) {
    const Json& buffer = (*list)[i];
    const std::string where = fmt::format("{}: buffers[{}]", file, i);
    std::span<const std::byte> bytes = binary;
    if (buffer.contains("uri")) {
      owned_.push_back(read_uri(buffer["uri"].get<std::string>(), folder, where + ".uri"));
      bytes = owned_.back();
    } else if (binary.empty()) {
      throw Error(
          fmt::format("{}.uri: missing; a file, data, or the binary chunk of a .glb file", where));
    }
    const auto length = buffer["byteLength"].get<std::uint64_t>();
    if (bytes.size() < length)
      throw Error(fmt::format("{}.byteLength: {}, but there are only {} bytes", where, length,
                              bytes.size()));
    spans_.push_back(bytes.first(length));
  }
}

}  // namespace airlight::gltf
