#pragma once
#include "render/kernel.h"

namespace airlight {

/// Settings made sense of: the estimator with its parameters, the kernel, the sample layout.
struct Prepared {
  Frame frame;
  const Kernel& kernel;
  SampleRange samples;
};

/// The estimator that the settings name, with its parameters. Throws Error with the accepted names.
Estimators estimator_for(const RenderSettings& settings);

/// The kernel that an estimator runs on: the reference for the exact one, which is there to judge
/// the others.
const Kernel& kernel_of(const Estimators& estimator, InstructionSet isa);

/// The light groups of a scene by name; the first has none: what belongs to no group.
std::vector<std::string> light_group_names(const Scene& scene);

/// What a film must keep of a scene for an estimator.
FilmLayout film_layout(const Scene& scene, const Estimators& estimator);

/// Whether all samples of a pixel share the ray through its centre.
bool goes_through_centre(const RenderSettings& settings);

/// Throws Error if the settings don't fit each other, the scene or the machine.
void check_settings(const Scene& scene, const RenderSettings& settings);

/// Of settings that `check_settings` lets pass.
Prepared prepare(const Scene& scene, const World& world, const RenderSettings& settings);

}  // namespace airlight
