#pragma once
#include <filesystem>
#include <functional>

#include "error.h"

namespace airlight {

/// Where a render keeps its sums, so that it can go on after an end that nobody asked for.
struct CheckpointPlan {
  std::filesystem::path file;
  double every = 60;    ///< how often it is written: no more is lost, and 128 samples of tiles  [s]
  bool resume = false;  ///< goes on with what the file holds, if it is there
  /// Told of a file that could not be written, by another thread but never beside on_progress; the
  /// render goes on. Told again only if it could be written in between, and at the end.
  /// Must not throw.
  std::function<void(const Error&)> on_failure;
};

}  // namespace airlight
