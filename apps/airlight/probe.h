#pragma once
#include <optional>
#include <string>

#include "render/probe.h"

/// A probe as tables to read, of all its rays or of one.
std::string probe_text(const airlight::Probe& probe, const airlight::Scene& scene,
                       std::optional<std::size_t> ray);

/// Everything a probe knows, as JSON with keys named as in render/probe.h; colours are [r, g, b].
std::string probe_json(const airlight::Probe& probe, const airlight::Scene& scene);

/// Density, transmittance and lit parts over the distance, for every light along one camera ray.
/// Throws airlight::Error if there is no light along it.
std::string probe_plot(const airlight::Probe& probe, std::size_t ray);
