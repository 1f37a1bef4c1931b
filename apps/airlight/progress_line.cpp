#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace {

/// "4.2 s", "1:05", "2:03:10".
std::string duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto s = std::llround(seconds);
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

ProgressLine::ProgressLine(bool wanted, std::string what)
    : wanted_(wanted && isatty(STDERR_FILENO)), what_(std::move(what)) {
  if (!what_.empty()) what_ += " | ";
}

void ProgressLine::show(const airlight::Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (!wanted_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const std::string remaining =
      progress.fraction > 0
          ? duration(progress.seconds * (1 - progress.fraction) / progress.fraction)
          : "?";
  fmt::print(stderr, "\r{}{} elapsed | {} remaining | {} of {} spp, {:.0f} %\x1b[K", what_,
             duration(progress.seconds), remaining, progress.samples_done, progress.samples,
             100 * progress.fraction);
  visible_ = true;
}

void ProgressLine::clear() {
  if (visible_) fmt::print(stderr, "\r\x1b[K");
  visible_ = false;
}
