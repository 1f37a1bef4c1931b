#pragma once
#include <atomic>
#include <chrono>
#include <mutex>
#include <span>
#include <vector>

#include "render/fair_mutex.h"
#include "render/prepare.h"
#include "render/render.h"

namespace airlight {

/// A film that gets its samples from many threads: tile by tile, and in passes over all tiles, so
/// that wherever it stops all pixels have about as many.
class Passes {
 public:
  /// Goes on with what the film holds. `seconds_before`: what that took.
  Passes(const Prepared& prepared, const RenderControl& control, Film& film,
         double seconds_before = 0);

  /// Until every pixel has all samples or the control stops it, on so many threads; 0: as many as
  /// the machine has.
  void run(std::int64_t threads);

  bool all_samples() const { return run_.least() >= prepared_.samples.count; }
  double seconds() const;  ///< since it began, with those before
  bool stopped() const { return stopped_; }
  std::int64_t rejected() const { return rejected_; }
  PathCount paths() const { return paths_; }

  /// One a tile, held while it is rendered.
  std::span<FairMutex> tile_locks() { return tile_locks_; }
  /// Held while a caller is told of anything.
  std::mutex& reporting() { return reporting_; }

 private:
  using Clock = std::chrono::steady_clock;

  double seconds_of_its_own() const;
  bool must_stop();
  std::uint32_t next_pass() const;
  void render_tile(int index, std::uint32_t count);
  void add_samples(int index, std::uint32_t added);

  const Prepared& prepared_;
  const RenderControl& control_;
  Film& film_;
  SampleRun& run_;
  const double seconds_before_;
  const Clock::time_point start_ = Clock::now();
  std::vector<FairMutex> tile_locks_;
  std::atomic<bool> stopped_ = false;
  std::atomic<std::int64_t> rejected_ = 0;
  std::mutex reporting_;
  PathCount paths_;
  Progress progress_;
  std::int64_t tile_samples_done_ = 0;  ///< summed over all tiles
};

}  // namespace airlight
