#pragma once
#include <condition_variable>
#include <functional>
#include <thread>

#include "render/checkpoint.h"
#include "render/checkpoint_plan.h"

namespace airlight {

/// Writes a film that is being rendered to a file every so often, from a thread of its own.
class CheckpointKeeper {
 public:
  /// `origin` tells about the film when asked, `locks` keep rendered tiles from being read.
  CheckpointKeeper(CheckpointPlan plan, const Film& film, std::span<FairMutex> locks,
                   std::function<Origin()> origin);
  ~CheckpointKeeper() = default;
  CheckpointKeeper(const CheckpointKeeper&) = delete;
  CheckpointKeeper& operator=(const CheckpointKeeper&) = delete;

  /// Ends the thread and writes the file once more; false if that failed.
  bool finish();

 private:
  bool write();

  const CheckpointPlan plan_;
  const Film& film_;
  std::span<FairMutex> locks_;
  std::function<Origin()> origin_;
  bool told_ = false;  ///< that it fails, since it last succeeded
  std::jthread thread_;
};

/// Throws Error if a plan's file cannot be written, or is there and not to be gone on with.
void check_place(const CheckpointPlan& plan);

/// What a plan finds in its file: nothing if there is none. Throws Error if the file is there but
/// not asked for, cannot be read, or holds what a render of these traits and settings into this
/// film would not.
std::optional<Checkpoint> resumed(const CheckpointPlan& plan, const Film& film,
                                  const Traits& traits, const RenderSettings& settings);

}  // namespace airlight
