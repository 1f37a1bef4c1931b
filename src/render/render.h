#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "render/checkpoint_plan.h"
#include "render/film.h"
#include "render/path_count.h"

namespace airlight {

/// How far a render is.
struct Progress {
  std::int64_t samples_done = 0;  ///< a pixel, in passes that are finished
  std::int64_t samples = 0;       ///< a pixel, asked for
  double fraction = 0;            ///< of all work, 0 to 1
  double seconds = 0;             ///< since the render began, with those before it was resumed
};

/// What a caller may want of a render while it runs. All of it is optional.
struct RenderControl {
  std::optional<PixelRect> crop;  ///< renders this part only
  double time_limit = 0;          ///< stops after this time with what is done; 0: no limit  [s]
  bool short_passes = false;      ///< of few samples a pixel, so that previews come often
  std::stop_token stop;           ///< stops with what is done
  /// Called from workers, one at a time. What it throws ends the render and is thrown by it.
  std::function<void(const Progress&)> on_progress;
  /// Called when every pixel has more samples. The same holds for what it throws.
  std::function<void(const Film&, const Progress&)> on_pass;
  std::optional<CheckpointPlan> checkpoint;  ///< where sums are kept, and where they begin
};

/// A finished picture and how it came about.
struct Rendered {
  Film film;
  double seconds = 0;  ///< from the first ray to the last, without loading; of all runs if resumed
  const char* instruction_set = "";
  std::int64_t samples = 0;  ///< that every pixel has
  bool complete = true;      ///< false if a limit or a stop cut it short
  bool kept = true;          ///< false if the last checkpoint could not be written
  std::int64_t rejected =
      0;                 ///< pixel sums that were not finite and were left out; a defect if not 0
  PathCount paths = {};  ///< of max_depth above 1
};

/// A scene made ready for rays; renders it as often as asked. The scene must outlive it.
class Renderer {
 public:
  explicit Renderer(const Scene& scene);
  explicit Renderer(const Scene&&) = delete;
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  /// Throws Error if the settings don't fit each other, the scene, the machine, or what is resumed.
  Rendered render(const RenderSettings& settings, const RenderControl& control = {});

  /// The name of the instruction set that `render` would use.
  const char* instruction_set(const RenderSettings& settings) const;

  /// Throws what `render` would throw for these settings, without a ray.
  void check(const RenderSettings& settings) const;

 private:
  struct Worlds;
  const Scene& scene_;
  std::unique_ptr<Worlds> worlds_;
};

/// Renders a scene once, as its file says.
Rendered render(const Scene& scene);

}  // namespace airlight
