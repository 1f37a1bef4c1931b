#pragma once
#include <string>
#include <vector>

namespace airlight {

/// How an axis maps numbers to paper.
enum class Scale {
  linear,
  log,   ///< ticks at decades, small ones between them
  log2,  ///< ticks at powers of two: for numbers of samples
};

struct Tick {
  double at = 0;
  std::string label;  ///< "" for small ticks between the labelled ones
};

/// Round values between low and high (low < high, both above zero on a log axis), in rising order,
/// of which about `wanted` and never more than twice as many carry a label.
std::vector<Tick> ticks(Scale scale, double low, double high, int wanted);

}  // namespace airlight
