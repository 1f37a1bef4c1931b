#include "image/mix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "error.h"

namespace airlight {
namespace {

/// A layer that is a colour.
const Layer* find(const Picture& picture, const std::string& name) {
  const auto found = std::ranges::find(picture.layers, name, &Layer::name);
  return found == picture.layers.end() || found->channels.size() != 3 ? nullptr : &*found;
}

/// One layer of every group, times its gain.
struct Part {
  Layer layer;
  std::array<float, 3> factor;
};

void scale(std::span<float> row, const std::array<float, 3>& factor) {
  for (std::size_t i = 0; i < row.size(); ++i) row[i] *= factor[i % 3];
}

Layer scaled(const Layer& layer, const std::array<float, 3>& factor) {
  Layer result = layer;
  result.fill = [fill = layer.fill, factor](int y, std::span<float> row) {
    fill(y, row);
    scale(row, factor);
  };
  return result;
}

Layer sum_of(const Layer& layer, const std::vector<Part>& parts) {
  Layer result = layer;
  result.fill = [parts](int y, std::span<float> row) {
    std::ranges::fill(row, 0);
    std::vector<float> part(row.size());
    for (const auto& [one, factor] : parts) {
      one.fill(y, part);
      scale(part, factor);
      std::ranges::transform(row, part, row.begin(), std::plus());
    }
  };
  return result;
}

}  // namespace

std::vector<std::string> light_groups(const Picture& picture) {
  std::vector<std::string> groups;
  for (const Layer& layer : picture.layers) {
    if (find(picture, layer.name) && find(picture, layer.name + ".in_scatter") &&
        find(picture, layer.name + ".surface"))
      groups.push_back(layer.name);
  }
  return groups;
}

Picture mix(const Picture& picture, const std::vector<Gain>& gains) {
  const std::vector<std::string> groups = light_groups(picture);
  if (groups.empty())
    throw Error("has no light groups; accepted: an EXR of a scene whose lights have a group");
  for (const Gain& gain : gains)
    if (std::ranges::find(groups, gain.group) == groups.end())
      throw Error(
          fmt::format("has no light group {}; it has: {}", gain.group, fmt::join(groups, ", ")));
  const auto factor_of = [&](const std::string& group) {
    const auto found = std::ranges::find(gains, group, &Gain::group);
    return found == gains.end() ? Gain().factor : found->factor;
  };

  Picture result = picture;
  result.layers.clear();
  for (const Layer& layer : picture.layers) {
    const std::string group = layer.name.substr(0, layer.name.find('.'));
    if (layer.name == "beauty" || layer.name == "in_scatter" || layer.name == "surface") {
      std::vector<Part> parts;
      for (const std::string& one : groups)
        parts.push_back({*find(picture, layer.name == "beauty" ? one : one + "." + layer.name),
                         factor_of(one)});
      result.layers.push_back(sum_of(layer, parts));
    } else if (std::ranges::find(groups, group) != groups.end()) {
      result.layers.push_back(scaled(layer, factor_of(group)));
    } else if (layer.name != "standard_error") {
      result.layers.push_back(layer);
    }
  }
  return result;
}

}  // namespace airlight
