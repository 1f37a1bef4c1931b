#include "render/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "error.h"
#include "scene/described.h"
#include "scene/joined_media.h"

namespace airlight {
namespace {

/// The seed of a frame's noise; that of frame 0 is the seed itself.
std::uint32_t noise_seed(const RenderSettings& settings) {
  const auto seed = std::uint32_t(settings.seed);
  if (settings.noise == Noise::still || settings.frame == 0) return seed;
  return mix_bits(mix_bits(seed ^ 0x6c8e9cf5u) + std::uint32_t(settings.frame));
}

bool has_disc(const Scene& scene) {
  return std::ranges::any_of(scene.lights, [](const Lights& light) {
    return std::visit([](const ParallelLight auto& l) { return l.angular_diameter > 0; }, light);
  });
}

bool all_opaque(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (!object.material.is_opaque()) return false;
  return true;
}

ParallelShadows shadows_of(const Scene& scene, const Directional& light) {
  return {scene, light.direction};
}
ParallelShadows shadows_of(const Scene& scene, const Collimated& beam) {
  return {scene, beam.direction, dot(beam.position, beam.direction)};
}

}  // namespace

const Kernel& kernel_of(const Estimators& estimator, InstructionSet isa) {
  // The exact estimator is there to judge the others: it computes in double only.
  return kernel_for(std::holds_alternative<ClosedForm>(estimator) ? InstructionSet::reference
                                                                  : isa);
}

Estimators estimator_for(const RenderSettings& settings) {
  std::optional<Estimators> estimator = estimator_named(settings.estimator);
  if (!estimator) {
    std::string names;
    for (const ShortName& s : short_names) names += std::string(s.name) + ", ";
    throw Error(fmt::format(
        "render.estimator = \"{}\" is not known here; accepted: {}{}, or placement+form with a "
        "placement of {} and a form of {}",
        settings.estimator, names, ClosedForm::name, family_words<Placements>(),
        family_words<Forms>()));
  }
  if (auto* sampled = std::get_if<Sampled>(&*estimator)) {
    sampled->intersect_every_step = settings.edges == Edges::per_step;
    if (auto* mixed = std::get_if<Mixed>(&sampled->placement)) {
      mixed->part = settings.mix_weight;
      mixed->partner = settings.mix_with == MixWith::equidistant ? Mixed::Partner::equidistant
                                                                 : Mixed::Partner::distance;
    }
  }
  return *estimator;
}

namespace {

/// Paths start from an estimator that samples, and go on from it if asked.
void check_paths(const Estimators& estimator, const RenderSettings& settings) {
  if (settings.max_depth == 1) return;
  const auto* sampled = std::get_if<Sampled>(&estimator);
  if (!sampled)
    throw Error(fmt::format(
        "render.max_depth = {}: estimator {} knows light that scatters once; accepted: 1, or an "
        "estimator that samples, such as rewv",
        settings.max_depth, settings.estimator));
  if (sampled->intersect_every_step)
    throw Error(fmt::format(
        "render.max_depth = {}: edges = \"per_step\" is the plain march of light that scatters "
        "once; accepted: 1, or edges = \"cached\"",
        settings.max_depth));
  const bool mixed = std::holds_alternative<Mixed>(sampled->placement);
  const bool whole = std::holds_alternative<WholeVolume>(sampled->placement);
  const bool fits = settings.continuation == Continuation::distance ||
                    settings.continuation == Continuation::sample || whole ||
                    (settings.continuation == Continuation::mix && mixed);
  if (!fits)
    throw Error(fmt::format(
        "render.continuation = \"{}\" goes on from samples of whole_volume, which estimator {} "
        "does not draw; accepted: \"distance\", \"sample\", or an estimator such as rewv or "
        "mcwvds",
        settings.continuation == Continuation::mix ? "mix" : "whole_volume", settings.estimator));
}

/// The estimator of a path's segments: the samples from which paths go on come from the mixture.
Estimators estimator_of_paths(Estimators estimator, const RenderSettings& settings) {
  auto* sampled = std::get_if<Sampled>(&estimator);
  if (!sampled || settings.max_depth == 1 || settings.continuation == Continuation::distance)
    return estimator;
  sampled->paths_go_on = true;
  if (settings.continuation == Continuation::mix &&
      !std::holds_alternative<Mixed>(sampled->placement))
    sampled->placement = Mixed{};
  return estimator;
}

}  // namespace

void check_settings(const Scene& scene, const RenderSettings& settings) {
  const Estimators estimator = estimator_for(settings);
  kernel_of(estimator, settings.isa);
  if (const std::int64_t n = settings.samples_per_ray;
      n != 0 && !std::has_single_bit(std::uint64_t(n)))
    throw Error(fmt::format(
        "render.samples_per_ray = {} is no power of two; accepted: 1, 2, 4, …, or 0 for all", n));
  if (settings.first_sample.value_or(0) + settings.spp > std::int64_t(1) << 29)
    throw Error(
        "render.first_sample + render.spp is too large; accepted: up to 536870912 together");
  if (std::holds_alternative<ClosedForm>(estimator) && !all_opaque(scene))
    throw Error(
        fmt::format("estimator {} cannot serve this scene: it knows the shadows of opaque objects "
                    "only; accepted: opaque objects alone, or another estimator",
                    ClosedForm::name));
  if (const Image& image = scene.background_image;
      !image.pixels.empty() && (image.channels != 3 || image.width != scene.resolution.width ||
                                image.height != scene.resolution.height))
    throw Error(fmt::format(
        "the background's picture has {} x {} pixels of {} channels; accepted: {} x {} of 3",
        image.width, image.height, image.channels, scene.resolution.width,
        scene.resolution.height));
  check_paths(estimator, settings);
  if (std::holds_alternative<ClosedForm>(estimator) &&
      settings.light_selection != LightSelection::all)
    throw Error(
        fmt::format("estimator {} has no samples that could ask one light each: accepted "
                    "with it is light_selection = \"all\"",
                    ClosedForm::name));
  if (const auto reason = cannot_be_joined(scene.media)) throw Error("media " + *reason);
  for (const Medium& medium : scene.media)
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      if (const char* reason = std::visit(
              [&](const auto& e) { return e.unsupported(medium, scene.lights[i]); }, estimator))
        throw Error(
            fmt::format("estimator {} cannot serve lights.{}: {}", settings.estimator, i, reason));
}

std::vector<std::string> light_group_names(const Scene& scene) {
  std::vector<std::string> names{""};
  for (const std::string& group : scene.light_groups)
    if (std::ranges::find(names, group) == names.end()) names.push_back(group);
  return names;
}

namespace {

bool holdouts_may_be_shadowed(const Scene& scene) {
  const bool fog = !scene.media.empty();
  const auto others = std::ranges::count(scene.objects, false, &Object::holdout);
  return !scene.lights.empty() && others < std::ssize(scene.objects) && (others > 0 || fog);
}

}  // namespace

FilmLayout film_layout(const Scene& scene, const Estimators& estimator) {
  const auto* sampled = std::get_if<Sampled>(&estimator);
  const bool ratio = sampled && std::holds_alternative<Ratio>(sampled->form);
  const bool glows = std::ranges::any_of(
      scene.media, [](const Medium& medium) { return medium.emission != Rgb<double>(); });
  return {.groups = int(light_group_names(scene).size()),
          .plain = !ratio || glows,
          .ratio = ratio,
          .shadow = holdouts_may_be_shadowed(scene)};
}

namespace {

std::vector<int> light_group_indices(const Scene& scene) {
  const std::vector<std::string> names = light_group_names(scene);
  std::vector<int> indices(scene.lights.size(), Frame::ungrouped);
  for (std::size_t i = 0; i < std::min(indices.size(), scene.light_groups.size()); ++i)
    indices[i] = int(std::ranges::find(names, scene.light_groups[i]) - names.begin());
  return indices;
}

}  // namespace

bool goes_through_centre(const RenderSettings& settings) {
  // A range of samples belongs to a longer run, whose rays are spread over the pixel unless all
  // share one.
  return settings.samples_per_ray == 0 ||
         (!settings.first_sample && settings.spp <= settings.samples_per_ray);
}

Prepared prepare(const Scene& scene, const World& world, const RenderSettings& settings) {
  const Estimators estimator = estimator_of_paths(estimator_for(settings), settings);
  Frame frame{.scene = scene,
              .world = world,
              .camera = camera_frame(scene.camera, scene.resolution),
              .estimator = estimator};
  if (std::holds_alternative<ClosedForm>(estimator))
    for (const Lights& light : scene.lights)
      std::visit([&](const auto& l) { frame.shadows.push_back(shadows_of(scene, l)); }, light);
  frame.paths = {.max_depth = int(settings.max_depth), .surface = settings.surface};
  if (settings.continuation != Continuation::distance) {
    // Every segment then scatters, and paths carry less for it instead of ending.
    frame.paths.roulette_below = 0.05;
    frame.paths.sample_sources = int(std::ranges::count_if(scene.lights, paths_go_on_from));
  }
  frame.layout = film_layout(scene, estimator);
  // What the sky and surfaces send into the medium is no part of a ratio.
  if (settings.max_depth > 1) frame.layout.plain = true;
  frame.light_group = light_group_indices(scene);
  frame.light_selection = settings.light_selection;
  frame.filter = settings.filter;
  frame.through_centre = goes_through_centre(settings);
  // Through the centre, samples that share a direction of a disc are few, so that a picture sees
  // many directions.
  constexpr std::uint32_t sharing = 4;
  frame.samples_per_ray = !frame.through_centre ? std::uint32_t(settings.samples_per_ray)
                          : has_disc(scene)     ? sharing
                                                : 1024;
  frame.samples_per_surface_ray =
      frame.through_centre ? sharing : std::min(frame.samples_per_ray, sharing);
  frame.seed = noise_seed(settings);
  return {frame,
          kernel_of(estimator, settings.isa),
          {std::uint32_t(settings.first_sample.value_or(0)), std::uint32_t(settings.spp)}};
}

}  // namespace airlight
