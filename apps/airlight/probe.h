#pragma once
#include <string>

#include "render/probe.h"

/// A probe as a table to read.
std::string probe_text(const airlight::Probe& probe, const airlight::Scene& scene);

/// Everything a probe knows, as JSON with keys named as in render/probe.h; colours are [r, g, b].
std::string probe_json(const airlight::Probe& probe, const airlight::Scene& scene);

/// Density, transmittance and lit parts over the distance, for every light along one camera ray.
/// Throws airlight::Error if the pixel has no such ray, or the ray no light.
std::string probe_plot(const airlight::Probe& probe, std::size_t ray);
