#pragma once
#include <functional>
#include <string>
#include <vector>

namespace airlight::bench {

/// The bound that a measured value has to keep.
struct Must {
  enum class Be { anything, at_least, at_most };
  Be be = Be::anything;
  double bound = 0;  ///< in the row's unit

  static constexpr Must at_least(double bound) { return {Be::at_least, bound}; }
  static constexpr Must at_most(double bound) { return {Be::at_most, bound}; }

  /// Whether a value keeps the bound; a NaN keeps none, not even "anything".
  bool holds(double value) const;

  /// ">= 7", "<= 0.85", or "" for anything.
  std::string text() const;
};

/// One line of the table: what was measured, and whether that is enough.
struct Row {
  std::string name;  ///< unlike every other row's: "box_transmittance.avx2"
  double value = 0;
  std::string unit;  ///< "ns a ray", "x", "%"
  Must must = {};
  std::string isa;  ///< the instruction set that was measured: "baseline", "avx2", "avx512"

  bool holds() const { return must.holds(value); }
};

/// What a file of this folder offers: a measurement that gives one row or a few. What this machine
/// cannot measure (AVX-512 where there is none) gives no row.
struct Bench {
  std::string name;     ///< what --filter looks at, and how its rows' names begin
  std::string meaning;  ///< one line for --list
  std::function<std::vector<Row>()> measure;
};

/// All there are, in the order of the table. To add one: a new file, and its lines in benches.cpp
/// and CMakeLists.txt.
std::vector<Bench> benches();

}  // namespace airlight::bench
