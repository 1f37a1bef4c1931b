#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace airlight {

/// What the sums of a render depend on, but for its seed and its samples: names and values.
/// Settings stand there as a file would say them, parts of the scene as a hash, "#…", of what they
/// mean. Threads and instruction set are no part of it: they change sums by rounding only.
using Traits = std::vector<std::pair<std::string, std::string>>;

/// The trait that tells whether a picture shows its background: "shown" or, where there is none,
/// too, "left out".
inline constexpr const char* what_is_behind = "what is behind";

/// The traits of a render, of settings that fit the scene.
Traits traits_of(const Scene& scene, const RenderSettings& settings);

/// How two renders differ, in words, "" if they don't: "not the same lights", "render.estimator is
/// mcwvds, not rewv".
std::string difference(const Traits& found, const Traits& wanted);

/// The value of one of them; "" if there is none.
std::string value_of(const Traits& traits, const std::string& name);

}  // namespace airlight
