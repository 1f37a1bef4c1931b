#include "study/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "image/input.h"
#include "render/prepare.h"
#include "render/render.h"

namespace airlight {
namespace {

/// The seed of a computed reference: far from those of the runs.
constexpr std::int64_t reference_seed = 0x5eed0000;
constexpr std::int64_t default_reference_spp = 16384;

/// Whether the closed form knows this scene and the pictures are point-sampled at pixel centres, as
/// its is.
bool has_exact_reference(const Renderer& renderer, RenderSettings settings) {
  if (settings.samples_per_ray != 0) return false;
  settings.estimator = "closed_form";
  try {
    renderer.check(settings);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Where rays are spread over a pixel, they are so at every count: a few samples don't share the
/// pixel's centre.
void spread_rays(RenderSettings& settings) {
  if (settings.samples_per_ray != 0 && !settings.first_sample) settings.first_sample = 0;
}

/// A render all of whose sums count. Throws Error otherwise: a hole in the picture is no noise.
Rendered whole(Rendered rendered, const RenderSettings& settings) {
  if (rendered.rejected > 0)
    throw Error(fmt::format("{}: {} sums of pixels were not finite", settings.estimator,
                            rendered.rejected));
  return rendered;
}

Image reference_of(const std::filesystem::path& file, Resolution resolution) {
  std::optional<Image> found = read_radiance(file);
  if (!found)
    throw Error(fmt::format(
        "--reference {}: is a picture for a screen, its light clipped at white or tone-mapped; "
        "accepted: .exr, .pfm or .hdr",
        file.string()));
  if (found->width != resolution.width || found->height != resolution.height)
    throw Error(fmt::format("{}: is {} x {} pixels; accepted: a reference of the scene's {} x {}",
                            file.string(), found->width, found->height, resolution.width,
                            resolution.height));
  return *std::move(found);
}

void make_reference(const Scene& scene, const ComparisonSettings& settings, Renderer& renderer,
                    Comparison& comparison) {
  if (!settings.reference_file.empty()) {
    comparison.reference_source = "the picture " + settings.reference_file.filename().string();
    return;
  }
  RenderSettings reference = scene.render;
  reference.light_selection = LightSelection::all;
  spread_rays(reference);
  if (settings.reference_spp == 0 && has_exact_reference(renderer, reference)) {
    reference.estimator = "closed_form";
    reference.spp = 1;
    comparison.reference_source = "the exact closed form, without noise";
    comparison.reference = whole(renderer.render(reference), reference).film.layer("beauty");
    return;
  }
  // Two halves with seeds of their own: what they differ by tells the error of both together.
  const std::int64_t spp =
      settings.reference_spp > 0 ? settings.reference_spp : default_reference_spp;
  reference.estimator = "rewv";
  reference.continuation = Continuation::distance;  // no weight of a path grows
  reference.spp = (spp + 1) / 2;
  reference.seed = reference_seed;
  Film film = whole(renderer.render(reference), reference).film;
  ++reference.seed;
  const Film other = whole(renderer.render(reference), reference).film;
  comparison.reference_error = compare(film.layer("beauty"), other.layer("beauty")).rmse / 2;
  film.merge(other);
  comparison.reference = film.layer("beauty");
  comparison.reference_source =
      fmt::format("rewv at {} spp with seeds of its own, whose RMSE is about {:.2g} W/(m² sr)",
                  2 * reference.spp, comparison.reference_error);
}

/// The count that an estimator reaches in the given time, at most `most_compared_spp`, from the
/// speed of runs that double until they take a good part of it.
std::int64_t samples_in(double seconds, Renderer& renderer, RenderSettings settings) {
  for (settings.spp = 1;; settings.spp *= 2) {
    const double taken = renderer.render(settings).seconds;
    if (taken > 0.4 * seconds)
      return std::clamp<std::int64_t>(std::llround(double(settings.spp) * seconds / taken), 1,
                                      most_compared_spp);
    if (settings.spp >= most_compared_spp) return most_compared_spp;
  }
}

/// A metric of each seed.
std::vector<double> values_of(const Measured& row, double Metrics::*metric) {
  std::vector<double> values;
  for (const Metrics& metrics : row.of_seeds) values.push_back(metrics.*metric);
  return values;
}

Measured measure(Renderer& renderer, RenderSettings settings, int seeds, const Image& reference,
                 Comparison& comparison) {
  Measured row{.estimator = settings.estimator,
               .spp = settings.spp,
               .seconds = {},
               .metrics = {},
               .of_seeds = {},
               .picture = {}};
  std::vector<double> seconds;
  const std::int64_t first_seed = settings.seed;
  for (int i = 0; i < seeds; ++i) {
    settings.seed = first_seed + i;
    const Rendered rendered = whole(renderer.render(settings), settings);
    comparison.instruction_set = rendered.instruction_set;
    Image picture = rendered.film.layer("beauty");
    row.of_seeds.push_back(compare(picture, reference));
    seconds.push_back(rendered.seconds);
    if (i == 0) row.picture = std::move(picture);
  }
  row.seconds = spread(seconds);
  for (std::size_t m = 0; m < metric_list.size(); ++m)
    row.metrics[m] = spread(values_of(row, metric_list[m].value));
  return row;
}

}  // namespace

Spread difference(const Measured& one, const Measured& other, double Metrics::*metric) {
  if (one.of_seeds.size() != other.of_seeds.size())
    throw Error(fmt::format("{} has {} seeds and {} has {}; accepted: equally many", one.estimator,
                            one.of_seeds.size(), other.estimator, other.of_seeds.size()));
  std::vector<double> values = values_of(one, metric);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= other.of_seeds[i].*metric;
  return spread(values);
}

const Measured& Comparison::of(const std::string& estimator, std::int64_t spp) const {
  return *std::ranges::find_if(
      rows, [&](const Measured& m) { return m.estimator == estimator && m.spp == spp; });
}

std::string warning_of(const Comparison& comparison) {
  std::string rows;
  for (const Measured& row : comparison.rows)
    if (comparison.reference_error > 0.5 * row.of(&Metrics::rmse).mean)
      rows += fmt::format("{}{} at {} spp", rows.empty() ? "" : ", ", row.estimator, row.spp);
  if (rows.empty()) return "";
  return fmt::format("the reference is too noisy to judge {}; give it more with --reference-spp",
                     rows);
}

Image check_comparison(const Scene& scene, const ComparisonSettings& settings) {
  for (const std::string& estimator : settings.estimators) {
    RenderSettings one = scene.render;
    one.estimator = estimator;
    try {
      estimator_for(one);
    } catch (const Error& error) {
      throw Error(fmt::format("--estimators {}: {}", estimator, error.what()));
    }
    check_settings(scene, one);
  }
  if (settings.reference_file.empty()) return {};
  return reference_of(settings.reference_file, scene.resolution);
}

Comparison compare_estimators(const Scene& scene, const ComparisonSettings& settings) {
  return compare_estimators(scene, settings, check_comparison(scene, settings));
}

Comparison compare_estimators(const Scene& scene, const ComparisonSettings& settings,
                              Image reference) {
  Renderer renderer(scene);
  Comparison comparison;
  comparison.reference = std::move(reference);
  make_reference(scene, settings, renderer, comparison);

  const std::vector<std::int64_t> counts =
      settings.equal_time > 0 ? std::vector<std::int64_t>{0} : settings.spp;
  for (const std::string& estimator : settings.estimators) {
    RenderSettings one = scene.render;
    one.estimator = estimator;
    spread_rays(one);
    one.spp = std::max<std::int64_t>(counts.front(), 1);
    renderer.render(one);  // so that the first run that counts finds everything warm
    for (std::int64_t spp : counts) {
      one.spp = spp > 0 ? spp : samples_in(settings.equal_time, renderer, one);
      comparison.rows.push_back(
          measure(renderer, one, settings.seeds, comparison.reference, comparison));
    }
  }
  return comparison;
}

}  // namespace airlight
