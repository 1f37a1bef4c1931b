#include "render/render.h"

#include <fmt/format.h>

#include <mutex>

#include "error.h"
#include "render/checkpoint_keeper.h"
#include "render/passes.h"
#include "render/version.h"

namespace airlight {
namespace {

PixelRect checked_crop(const std::optional<PixelRect>& crop, Resolution full) {
  if (!crop) return {0, 0, full.width, full.height};
  if (crop->x0 < 0 || crop->y0 < 0 || crop->width < 1 || crop->height < 1 ||
      crop->width > full.width - crop->x0 || crop->height > full.height - crop->y0)
    throw Error(fmt::format(
        "crop {},{},{},{} does not lie in the picture; accepted: X,Y,W,H inside {} x {}", crop->x0,
        crop->y0, crop->width, crop->height, full.width, full.height));
  return *crop;
}

/// The film of a render, without a sample yet.
Film empty_film(const Scene& scene, const RenderSettings& settings, const Prepared& prepared,
                const PixelRect& crop) {
  Film film(scene.resolution, crop, prepared.frame.layout, light_group_names(scene));
  film.runs = {{std::uint32_t(settings.seed), prepared.samples.first,
                std::vector<std::uint32_t>(std::size_t(film.tile_count()))}};
  return film;
}

/// Writes the film of the passes to the checkpoint that the control asks for, while they run.
void keep(std::optional<CheckpointKeeper>& keeper, Passes& passes, const Film& film,
          const RenderControl& control, const Traits& traits, const char* instruction_set) {
  CheckpointPlan plan = *control.checkpoint;
  plan.on_failure = [&](const Error& error) {
    const std::scoped_lock lock(passes.reporting());
    if (control.checkpoint->on_failure) control.checkpoint->on_failure(error);
  };
  keeper.emplace(plan, film, passes.tile_locks(), [&passes, &traits, instruction_set] {
    return Origin{traits, passes.seconds(), instruction_set, version()};
  });
}

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
  Rendered result{.film = empty_film(scene_, settings, prepared, crop)};
  result.instruction_set = prepared.kernel.name;

  double seconds_before = 0;
  Traits traits;
  if (control.checkpoint) {
    traits = traits_of(scene_, settings);
    if (auto found = resumed(*control.checkpoint, result.film, traits, settings)) {
      result.film = std::move(found->film);
      seconds_before = found->origin.seconds;
    }
  }

  Passes passes(prepared, control, result.film, seconds_before);
  std::optional<CheckpointKeeper> keeper;
  if (control.checkpoint && !passes.all_samples())
    keep(keeper, passes, result.film, control, traits, result.instruction_set);
  passes.run(settings.threads);

  result.seconds = passes.seconds();
  result.kept = !keeper || keeper->finish();
  result.samples = result.film.samples();
  result.complete = !passes.stopped();
  result.rejected = passes.rejected();
  result.paths = passes.paths();
  return result;
}

Rendered render(const Scene& scene) { return Renderer(scene).render(scene.render); }

}  // namespace airlight
