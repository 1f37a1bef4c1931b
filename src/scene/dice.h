#pragma once
#include <airlight/math/random.h>

#include <cstdint>

namespace airlight {

/// Numbers in [0, 1), the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(mix_bits(seed + 0x9e3779b9u)) {}

  double operator()() { return double(mix_bits(state_ += 0x9e3779b9u)) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint32_t state_;
};

}  // namespace airlight
