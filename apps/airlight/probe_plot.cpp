#include <fmt/format.h>

#include "error.h"
#include "probe.h"
#include "report/svg.h"

namespace {

using namespace airlight;

bool is_grey(const ProbedLight& light) {
  for (const ProbedStep& step : light.steps)
    if (step.transmittance.r != step.transmittance.g ||
        step.transmittance.g != step.transmittance.b)
      return false;
  return true;
}

Line curve(const std::string& name, const ProbedLight& light, auto value) {
  Line line{.name = name, .x = {}, .y = {}};
  line.markers = false;
  for (const ProbedStep& step : light.steps) {
    line.x.push_back(step.t);
    line.y.push_back(value(step));
  }
  return line;
}

Plot density(const ProbedLight& light, const Axis& t, const std::string& title) {
  Plot plot{.title = title, .x = t, .y = {"density [1/m]", Scale::linear, 0}};
  plot.marks.push_back(Shade{"lit", light.lit});
  plot.marks.push_back(curve("pdf", light, [](const ProbedStep& s) { return s.pdf; }));
  Line samples{.name = "samples", .x = {}, .y = {}};
  samples.joined = false;
  for (const ProbedSample& s : light.samples) {
    samples.x.push_back(s.t);
    samples.y.push_back(s.pdf);
  }
  if (!samples.x.empty()) plot.marks.push_back(samples);
  return plot;
}

Plot transmittance(const ProbedLight& light, const Axis& t) {
  Plot plot{.x = t, .y = {"transmittance", Scale::linear, 0}};
  plot.marks.push_back(Shade{"lit", light.lit});
  if (is_grey(light)) {
    plot.marks.push_back(
        curve("light to camera", light, [](const ProbedStep& s) { return s.transmittance.r; }));
  } else {
    struct Channel {
      const char* name;
      double Rgb<double>::*value;
      int colour;  // of the plot's palette
    };
    constexpr Channel channels[] = {
        {"red", &Rgb<double>::r, 1}, {"green", &Rgb<double>::g, 2}, {"blue", &Rgb<double>::b, 0}};
    for (const Channel& c : channels) {
      Line line =
          curve(c.name, light, [&](const ProbedStep& s) { return s.transmittance.*c.value; });
      line.colour = c.colour;
      plot.marks.push_back(line);
    }
  }
  for (const ProbedNode& node : light.nodes) plot.marks.push_back(Rule{node.t});
  return plot;
}

}  // namespace

std::string probe_plot(const Probe& probe, std::size_t ray) {
  const ProbedRay& shown = probe.rays[ray];
  if (shown.lights.empty())
    throw Error(
        fmt::format("pixel {},{}: there is nothing to plot: the ray crosses no medium with a light",
                    probe.x, probe.y));
  const Axis t{.label = "distance from the camera [m]", .low = shown.t_enter, .high = shown.t_exit};
  std::vector<Plot> plots;
  for (const ProbedLight& light : shown.lights) {
    plots.push_back(density(light, t,
                            fmt::format("lights.{} along ray {} of pixel {},{}, {}", light.light,
                                        ray, probe.x, probe.y, probe.estimator)));
    plots.push_back(transmittance(light, t));
  }
  return svg(plots);
}
