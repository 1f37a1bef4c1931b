#include "image/mix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "error.h"
#include "image/shadow.h"

namespace airlight {
namespace {

/// The group of what belongs to no light's group.
const std::string ungrouped = "ungrouped";

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

/// The light on holdouts that was in a picture and that is there now, and what it makes of them.
struct Holdouts {
  struct Light {
    Layer lit, was_lit;
  };
  Layer seen, plate, transmittance;
  Light before, now;

  /// What is left of the light: 1 where there was none.
  static std::vector<float> left(const Light& light, int y, std::size_t values) {
    std::vector<float> lit(values), was_lit(values);
    light.lit.fill(y, lit), light.was_lit.fill(y, was_lit);
    std::ranges::transform(lit, was_lit, lit.begin(),
                           [](float is, float was) { return was > 0 ? is / was : 1; });
    return lit;
  }
};

/// None in a picture without such layers. parts(".lit") are those layers of all groups.
template <class Parts>
std::optional<Holdouts> holdouts_of(const Picture& picture, const Parts& parts) {
  const Layer *seen = find(picture, "holdout_seen"), *plate = find(picture, "holdout_plate"),
              *transmittance = find(picture, "transmittance");
  const std::vector<Part> lit = parts(".holdout_lit"), was_lit = parts(".holdout_was_lit");
  if (!seen || !plate || !transmittance || lit.empty() || lit.size() != was_lit.size()) return {};
  const auto sum = [](std::vector<Part> all, bool as_it_was) {
    if (as_it_was)
      for (Part& part : all) part.factor = Gain().factor;
    return sum_of(all[0].layer, all);
  };
  return Holdouts{*seen,
                  *plate,
                  *transmittance,
                  {sum(lit, true), sum(was_lit, true)},
                  {sum(lit, false), sum(was_lit, false)}};
}

/// The layer "shadow" in the light that is there now.
Layer shadow(const Layer& layer, const Holdouts& holdouts) {
  Layer result = layer;
  result.fill = [holdouts](int y, std::span<float> row) {
    const std::vector<float> left = Holdouts::left(holdouts.now, y, row.size());
    std::vector<float> seen(row.size()), transmittance(row.size());
    holdouts.seen.fill(y, seen), holdouts.transmittance.fill(y, transmittance);
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = shadow_on_background(seen[i], transmittance[i], left[i]);
  };
  return result;
}

/// A layer in which the background shows, once its shadows have changed.
Layer with_shadows(const Layer& layer, const Holdouts& holdouts, std::array<float, 3> factor) {
  Layer result = layer;
  result.fill = [fill = layer.fill, holdouts, factor](int y, std::span<float> row) {
    fill(y, row);
    const std::vector<float> before = Holdouts::left(holdouts.before, y, row.size()),
                             now = Holdouts::left(holdouts.now, y, row.size());
    std::vector<float> plate(row.size());
    holdouts.plate.fill(y, plate);
    scale(plate, factor);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] += plate[i] * (now[i] - before[i]);
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

  const auto parts = [&](const std::string& suffix) {
    std::vector<Part> all;
    for (const std::string& group : groups)
      if (const Layer* layer = find(picture, group + suffix))
        all.push_back({*layer, factor_of(group)});
    return all;
  };
  const std::optional<Holdouts> holdouts = holdouts_of(picture, parts);

  Picture result = picture;
  result.layers.clear();
  for (const Layer& layer : picture.layers) {
    const std::string& name = layer.name;
    const std::string group = name.substr(0, name.find('.'));
    const bool is_sum = name == "beauty" || name == "in_scatter" || name == "surface";
    const auto add = [&](Layer changed) {
      const bool shows_background = name == "beauty" || name == "surface" || name == ungrouped ||
                                    name == ungrouped + ".surface";
      result.layers.push_back(holdouts && shows_background
                                  ? with_shadows(changed, *holdouts, factor_of(ungrouped))
                                  : std::move(changed));
    };
    if (is_sum)
      add(sum_of(layer, parts(name == "beauty" ? "" : "." + name)));
    else if (std::ranges::find(groups, group) != groups.end())
      add(scaled(layer, factor_of(group)));
    else if (holdouts && name == "holdout_plate")
      add(scaled(layer, factor_of(ungrouped)));
    else if (holdouts && name == "shadow")
      add(shadow(layer, *holdouts));
    else if (name != "standard_error")
      add(layer);
  }
  if (holdouts && result.alpha) add_alpha(result);
  return result;
}

}  // namespace airlight
