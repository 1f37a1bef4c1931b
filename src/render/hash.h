#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace airlight {

/// Tells bytes from others: 64 bits, against accidents, not against forgers. Every step is
/// invertible, so that no single changed word goes unnoticed. Eight bytes take a few cycles.
class Hash {
 public:
  void add(std::uint64_t word) noexcept {
    state_ =
        (state_ ^ word) * 0x9e3779b97f4a7c15;  // odd, its bits well spread: 2^64 / golden ratio
    state_ ^= std::rotr(state_, 32) & 0xffffffff;
  }

  /// Pieces count: the same bytes cut elsewhere give another value.
  void add(std::span<const std::byte> bytes) noexcept {
    add(std::uint64_t(bytes.size()));
    while (!bytes.empty()) {
      std::uint64_t word = 0;
      const std::size_t count = std::min(bytes.size(), sizeof word);
      std::memcpy(&word, bytes.data(), count);
      add(word);
      bytes = bytes.subspan(count);
    }
  }

  std::uint64_t value() const noexcept { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325;
};

}  // namespace airlight
