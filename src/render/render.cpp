#include "render/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "error.h"
#include "geometry/flush_to_zero.h"
#include "render/checkpoint_keeper.h"
#include "render/prepare.h"
#include "render/version.h"

namespace airlight {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

PixelRect checked_crop(const std::optional<PixelRect>& crop, Resolution full) {
  if (!crop) return {0, 0, full.width, full.height};
  if (crop->x0 < 0 || crop->y0 < 0 || crop->width < 1 || crop->height < 1 ||
      crop->width > full.width - crop->x0 || crop->height > full.height - crop->y0)
    throw Error(fmt::format(
        "crop {},{},{},{} does not lie in the picture; accepted: X,Y,W,H inside {} x {}", crop->x0,
        crop->y0, crop->width, crop->height, full.width, full.height));
  return *crop;
}

/// How many samples the next pass gives each pixel: as many as it has, so that passes are few, up
/// to a length. Previews come after passes that stay short.
std::uint32_t next_pass(std::uint32_t asked, std::uint32_t done, const RenderControl& control) {
  const std::uint32_t first = control.short_passes || control.time_limit > 0 ? 4 : 64;
  const std::uint32_t longest = control.short_passes ? 64 : 1024;
  return std::min({asked - done, std::max(done, first), longest});
}

/// How many samples a tile gets at a time. They are summed in float before they are added to the
/// film in double, where longer runs would drift; a checkpoint waits for no more, and no more is
/// lost of it if the program is killed.
constexpr std::uint32_t tile_samples = 128;

}  // namespace

/// One world for each way to answer visibility, built when it is first asked for.
struct Renderer::Worlds {
  std::array<std::optional<World>, std::size(words<Visibility>)> built;

  const World& get(const Scene& scene, Visibility visibility) {
    std::optional<World>& world = built[std::size_t(visibility)];
    if (!world) world.emplace(scene, visibility);
    return *world;
  }
};

Renderer::Renderer(const Scene& scene) : scene_(scene), worlds_(std::make_unique<Worlds>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

const char* Renderer::instruction_set(const RenderSettings& settings) const {
  return kernel_of(estimator_for(settings), settings.isa).name;
}

void Renderer::check(const RenderSettings& settings) const { check_settings(scene_, settings); }

Rendered Renderer::render(const RenderSettings& settings, const RenderControl& control) {
  check(settings);
  const PixelRect crop = checked_crop(control.crop, scene_.resolution);
  const Prepared prepared = prepare(scene_, worlds_->get(scene_, settings.visibility), settings);
  Rendered result{
      .film = Film(scene_.resolution, crop, prepared.frame.layout, light_group_names(scene_))};
  Film& film = result.film;
  film.runs = {{std::uint32_t(settings.seed), prepared.samples.first,
                std::vector<std::uint32_t>(std::size_t(film.tile_count()))}};
  result.instruction_set = prepared.kernel.name;

  double seconds_before = 0;
  Traits traits;
  if (control.checkpoint) {
    traits = traits_of(scene_, settings);
    if (auto found = resumed(*control.checkpoint, film, traits, settings)) {
      film = std::move(found->film);
      seconds_before = found->origin.seconds;
    }
  }
  SampleRun& run = film.runs[0];

  std::vector<FairMutex> tile_locks(run.counts.size());
  std::atomic<std::int64_t> rejected = 0;
  std::atomic<bool> stopped = false;
  std::mutex reporting;
  Progress progress{.samples_done = run.least(), .samples = prepared.samples.count};
  std::int64_t sample_tiles_done = 0;
  for (const std::uint32_t count : run.counts) sample_tiles_done += count;
  const auto start = Clock::now();
  const auto seconds = [&] { return seconds_before + seconds_since(start); };

  const auto must_stop = [&] {
    if (control.stop.stop_requested() ||
        (control.time_limit > 0 && seconds_since(start) >= control.time_limit))
      stopped = true;
    return stopped.load();
  };

  /// Gives a tile more samples.
  const auto add_samples = [&](int index, std::uint32_t added) {
    std::uint32_t& done = run.counts[std::size_t(index)];
    Tile tile{film.tile(index), {run.first + done, added}, film};
    {
      const FlushToZero flush;  // not while a caller is told of it
      const std::scoped_lock lock(tile_locks[std::size_t(index)]);
      prepared.kernel.render(prepared.frame, tile);
      done += added;
    }
    rejected += tile.rejected;
    const std::scoped_lock lock(reporting);
    result.paths += tile.paths;
    if (!control.on_progress) return;
    sample_tiles_done += added;
    progress.fraction =
        double(sample_tiles_done) / (double(film.tile_count()) * double(prepared.samples.count));
    progress.seconds = seconds();
    control.on_progress(progress);
  };

  /// Takes a tile from what it has to `count` samples.
  const auto render_tile = [&](int index, std::uint32_t count) {
    const std::uint32_t& done = run.counts[std::size_t(index)];
    while (done < count && !must_stop()) add_samples(index, std::min(count - done, tile_samples));
  };

  std::optional<CheckpointKeeper> keeper;
  if (control.checkpoint && run.least() < prepared.samples.count) {
    CheckpointPlan plan = *control.checkpoint;
    plan.on_failure = [&](const Error& error) {
      const std::scoped_lock lock(reporting);
      if (control.checkpoint->on_failure) control.checkpoint->on_failure(error);
    };
    keeper.emplace(plan, film, tile_locks, [&] {
      return Origin{traits, seconds(), prepared.kernel.name, version()};
    });
  }

  const int threads = settings.threads > 0 ? int(settings.threads) : tbb::task_arena::automatic;
  const tbb::global_control allow_more(
      tbb::global_control::max_allowed_parallelism,
      std::max<std::size_t>(
          std::size_t(settings.threads),
          tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
  tbb::task_arena arena(threads);
  while (run.least() < prepared.samples.count) {
    const std::uint32_t pass_end =
        run.least() + next_pass(prepared.samples.count, run.least(), control);
    // From the last tile to the first: a checkpoint is written the other way and waits for a tile
    // that is being rendered. It meets each worker once, and does not follow one from tile to tile.
    arena.execute([&] {
      const int last = film.tile_count() - 1;
      tbb::parallel_for(0, last + 1, [&](int i) { render_tile(last - i, pass_end); });
    });
    if (stopped) break;
    progress.samples_done = run.least();
    progress.seconds = seconds();
    if (control.on_pass) control.on_pass(film, progress);
  }
  result.seconds = seconds();
  result.kept = !keeper || keeper->finish();
  result.samples = film.samples();
  result.complete = !stopped;
  result.rejected = rejected;
  return result;
}

Rendered render(const Scene& scene) { return Renderer(scene).render(scene.render); }

}  // namespace airlight
