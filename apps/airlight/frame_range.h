#pragma once
#include <cstdint>
#include <string>

/// The frames that a run renders, both ends among them.
struct FrameRange {
  std::int64_t first = 0;
  std::int64_t last = 0;

  std::int64_t count() const { return last - first + 1; }
};

/// Takes "0..47", or "12" for one. Throws airlight::Error.
FrameRange frame_range(const std::string& text);
