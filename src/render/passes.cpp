#include "render/passes.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "geometry/flush_to_zero.h"

namespace airlight {
namespace {

/// How many samples a tile gets at a time. They are summed in float before they are added to the
/// film in double, where longer runs would drift; a checkpoint waits for no more, and no more is
/// lost of it if the program is killed.
constexpr std::uint32_t samples_at_a_time = 128;

}  // namespace

Passes::Passes(const Prepared& prepared, const RenderControl& control, Film& film,
               double seconds_before)
    : prepared_(prepared),
      control_(control),
      film_(film),
      run_(film.runs[0]),
      seconds_before_(seconds_before),
      tile_locks_(run_.counts.size()),
      progress_{.samples_done = run_.least(), .samples = prepared.samples.count} {
  for (const std::uint32_t count : run_.counts) tile_samples_done_ += count;
}

void Passes::run(std::int64_t threads) {
  using tbb::global_control;
  const global_control allow_more(
      global_control::max_allowed_parallelism,
      std::max(std::size_t(threads),
               global_control::active_value(global_control::max_allowed_parallelism)));
  tbb::task_arena arena(threads > 0 ? int(threads) : tbb::task_arena::automatic);
  while (!all_samples()) {
    const std::uint32_t pass_end = run_.least() + next_pass();
    // From the last tile to the first: a checkpoint is written the other way and waits for a tile
    // that is being rendered. It meets each worker once, and does not follow one from tile to tile.
    arena.execute([&] {
      const int last = film_.tile_count() - 1;
      tbb::parallel_for(0, last + 1, [&](int i) { render_tile(last - i, pass_end); });
    });
    if (stopped_) return;
    progress_.samples_done = run_.least();
    progress_.seconds = seconds();
    if (control_.on_pass) control_.on_pass(film_, progress_);
  }
}

/// How many samples the next pass gives each pixel: as many as it has, so that passes are few, up
/// to a length. Previews come after passes that stay short.
std::uint32_t Passes::next_pass() const {
  const std::uint32_t done = run_.least();
  const std::uint32_t first = control_.short_passes || control_.time_limit > 0 ? 4 : 64;
  const std::uint32_t longest = control_.short_passes ? 64 : 1024;
  return std::min({prepared_.samples.count - done, std::max(done, first), longest});
}

/// Takes a tile from what it has to `count` samples.
void Passes::render_tile(int index, std::uint32_t count) {
  const std::uint32_t& done = run_.counts[std::size_t(index)];
  while (done < count && !must_stop())
    add_samples(index, std::min(count - done, samples_at_a_time));
}

void Passes::add_samples(int index, std::uint32_t added) {
  std::uint32_t& done = run_.counts[std::size_t(index)];
  Tile tile{film_.tile(index), {run_.first + done, added}, film_};
  {
    const FlushToZero flush;  // not while a caller is told of it
    const std::scoped_lock lock(tile_locks_[std::size_t(index)]);
    prepared_.kernel.render(prepared_.frame, tile);
    done += added;
  }
  rejected_ += tile.rejected;
  const std::scoped_lock lock(reporting_);
  paths_ += tile.paths;
  if (!control_.on_progress) return;
  tile_samples_done_ += added;
  progress_.fraction =
      double(tile_samples_done_) / (double(film_.tile_count()) * double(prepared_.samples.count));
  progress_.seconds = seconds();
  control_.on_progress(progress_);
}

bool Passes::must_stop() {
  if (control_.stop.stop_requested() ||
      (control_.time_limit > 0 && seconds_of_its_own() >= control_.time_limit))
    stopped_ = true;
  return stopped_;
}

double Passes::seconds_of_its_own() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

double Passes::seconds() const { return seconds_before_ + seconds_of_its_own(); }

}  // namespace airlight
