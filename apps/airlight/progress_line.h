#pragma once
#include <chrono>
#include <string>

#include "render/render.h"

/// One line on a terminal that tells how far a render is: elapsed | remaining | samples done. Shows
/// nothing where stderr is no terminal.
class ProgressLine {
 public:
  /// `what` stands first, such as "frame 3".
  explicit ProgressLine(bool wanted, std::string what = "");
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the line, ten times a second at most.
  void show(const airlight::Progress& progress);

  /// Takes the line away, so that something else can be printed.
  void clear();

 private:
  bool wanted_;
  std::string what_;
  bool visible_ = false;
  std::chrono::steady_clock::time_point next_;
};
