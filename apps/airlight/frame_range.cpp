#include "frame_range.h"

#include "error.h"
#include "numbers.h"

FrameRange frame_range(const std::string& text) {
  constexpr std::int64_t most = 1 << 24;
  const std::size_t dots = text.find("..");
  const auto first = whole_numbers(text.substr(0, dots), '.');
  const auto last = dots == std::string::npos ? first : whole_numbers(text.substr(dots + 2), '.');
  if (first.size() != 1 || last.size() != 1 || first[0] < 0 || last[0] > most)
    throw airlight::Error(
        "--frames " + text +
        ": are no frames; accepted: FIRST..LAST counted from 0 up to 16777216, such as 0..47, "
        "or one number");
  if (last[0] < first[0])
    throw airlight::Error("--frames " + text + ": is empty; the last frame comes before the first");
  return {first[0], last[0]};
}
