#include "render/checkpoint_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "image/atomic_file.h"

namespace airlight {

CheckpointKeeper::CheckpointKeeper(CheckpointPlan plan, const Film& film,
                                   std::span<FairMutex> locks, std::function<Origin()> origin)
    : plan_(std::move(plan)), film_(film), locks_(locks), origin_(std::move(origin)) {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex sleeping;
    std::condition_variable_any alarm;
    std::unique_lock lock(sleeping);
    const auto interval = std::chrono::duration<double>(plan_.every);
    while (!alarm.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) write();
  });
}

bool CheckpointKeeper::finish() {
  thread_.request_stop();
  thread_.join();
  told_ = false;
  return write();
}

bool CheckpointKeeper::write() {
  const auto fail = [this](const Error& error) {
    if (plan_.on_failure && !std::exchange(told_, true)) plan_.on_failure(error);
    return false;
  };
  try {
    write_checkpoint(plan_.file, film_, origin_(), locks_);
    told_ = false;
    return true;
  } catch (const Error& error) {
    return fail(error);
  } catch (const std::exception& error) {  // such as want of memory: nobody is above this thread
    return fail(Error(fmt::format("{}: cannot be written: {}", plan_.file.string(), error.what())));
  }
}

void check_place(const CheckpointPlan& plan) {
  check_writable(plan.file);
  if (!plan.resume && std::filesystem::is_regular_file(plan.file))
    throw Error(plan.file.string() +
                ": is there already; accepted: a new file, or --resume to go on with it");
}

namespace {

/// Throws Error if a file is of another render.
void check_origin(const Checkpoint& found, const std::string& file, const Traits& traits,
                  const RenderSettings& settings) {
  const std::string differs = difference(found.origin.traits, traits);
  if (differs.empty()) return;
  Traits through_centre = traits;
  std::ranges::find(through_centre, "render.samples_per_ray", &Traits::value_type::first)->second =
      "all";
  if (!difference(found.origin.traits, through_centre).empty())
    throw Error(fmt::format("{}: is of another render: {}", file, differs));
  throw Error(fmt::format(
      "{}: holds samples through the centres of pixels, as --spp up to {} takes them; accepted: "
      "--samples-per-ray all, to go on there, or a new file, with --first-sample 0 from the start",
      file, settings.samples_per_ray));
}

}  // namespace

std::optional<Checkpoint> resumed(const CheckpointPlan& plan, const Film& film,
                                  const Traits& traits, const RenderSettings& settings) {
  check_place(plan);
  const std::string file = plan.file.string();
  if (!std::filesystem::is_regular_file(plan.file)) return std::nullopt;
  Checkpoint found = read_checkpoint(plan.file);
  check_origin(found, file, traits, settings);
  if (part_of(found.film) != part_of(film))
    throw Error(
        fmt::format("{}: holds {}; this render has {}", file, part_of(found.film), part_of(film)));
  if (found.film.layout != film.layout || found.film.groups != film.groups)
    throw Error(file + ": holds other sums; accepted: those of this version of Airlight");
  if (found.film.runs.size() != 1)
    throw Error(file +
                ": holds samples that do not follow each other; accepted: one range of them");
  const SampleRun &run = found.film.runs[0], &own = film.runs[0];
  if (run.seed != own.seed || run.first != own.first)
    throw Error(fmt::format(
        "{}: holds samples of seed {} from {} on; this render takes those of seed {} from {} on",
        file, run.seed, run.first, own.seed, own.first));
  if (run.most() > settings.spp)
    throw Error(fmt::format("{}: holds {} samples a pixel already; accepted: --spp {} or more",
                            file, run.most(), run.most()));
  return found;
}

}  // namespace airlight
