// What the sums of a film say: the layers of its picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "error.h"
#include "image/shadow.h"
#include "render/film.h"

namespace airlight {
namespace {

double per_sample(const PixelSums& pixel) {
  const double n = pixel.sample_count();
  return n > 0 ? 1 / n : 0;
}

Rgb<double> in_scatter(const PixelSums& pixel) { return mean_estimate(pixel).radiance(); }

Rgb<double> surface(const PixelSums& pixel) { return pixel.visible() * per_sample(pixel); }

Rgb<double> shadow(const PixelSums& pixel) {
  Rgb<double> result;
  for (int c = 0; c < 3; ++c)
    result[c] =
        shadow_on_background(pixel.holdouts.seen[c], pixel.transmittance[c], pixel.shadow[c]);
  return result;
}

Rgb<double> beauty(const PixelSums& pixel) { return in_scatter(pixel) + surface(pixel); }

/// The difference of the two halves, each with its own quotient. The first is the whole less the
/// second, a sum of floats: the rounding that is left where it has nothing is no quotient.
Rgb<double> halves_apart(const PixelSums& pixel) {
  constexpr double rounding = 1e-6;
  auto [first, second] = pixel.in_scatter;
  for (int c = 0; c < 3; ++c)
    if (first.unoccluded[c] <= rounding * second.unoccluded[c]) first.unoccluded[c] = 0;
  const auto radiance = [&](const Estimate<double>& half, std::size_t i) {
    return (half * (1 / pixel.samples[i])).radiance();
  };
  return radiance(first, 0) - radiance(second, 1);
}

const std::vector<std::string> rgb = {"R", "G", "B"};

/// A row of pixels of all groups, read once for all layers that are asked for it in turn, as
/// `Layer::fill` allows.
class PixelRow {
 public:
  explicit PixelRow(const Film& film) : film_(film) {}

  void read(int y) {
    if (y == y_) return;
    const auto width = std::size_t(film_.crop.width);
    pixels_.resize(std::size_t(film_.layout.groups) * width);
    for (int group = 0; group < film_.layout.groups; ++group)
      for (std::size_t x = 0; x < width; ++x)
        pixels_[std::size_t(group) * width + x] = film_.pixel(std::size_t(y) * width + x, group);
    y_ = y;
  }

  const PixelSums& at(std::size_t x, int group = 0) const {
    return pixels_[std::size_t(group) * std::size_t(film_.crop.width) + x];
  }

 private:
  const Film& film_;
  int y_ = -1;
  std::vector<PixelSums> pixels_;
};

}  // namespace

Estimate<double> mean_estimate(const PixelSums& pixel) {
  Estimate<double> sum = pixel.in_scatter[0];
  sum += pixel.in_scatter[1];
  return sum * per_sample(pixel);
}

Rgb<double> Film::radiance(int x, int y) const {
  const std::size_t index = std::size_t(y) * std::size_t(crop.width) + std::size_t(x);
  Rgb<double> sum;
  for (int group = 0; group < layout.groups; ++group) sum += beauty(pixel(index, group));
  return sum;
}

Picture Film::picture() const {
  Picture result;
  if (!runs.empty()) {
    std::set<std::uint32_t> seeds;
    for (const SampleRun& run : runs) seeds.insert(run.seed);
    result.metadata = {
        {"spp", samples()},
        {"first_sample", std::int64_t(std::ranges::min(runs, {}, &SampleRun::first).first)},
        {"seed", seeds.size() == 1 ? MetadataValue(std::int64_t(*seeds.begin()))
                                   : MetadataValue(fmt::format("{}", fmt::join(seeds, ", ")))}};
  }
  result.width = crop.width;
  result.height = crop.height;
  if (crop.width != full.width || crop.height != full.height)
    result.crop = Crop{crop.x0, crop.y0, full.width, full.height};

  const auto pixels = std::make_shared<PixelRow>(*this);
  const int group_count = layout.groups;
  const auto add_layer = [&](std::string name, std::vector<std::string> channels, Storage storage,
                             auto put) {  // put(x, the pixel's place in the row)
    const std::size_t count = channels.size();
    result.layers.push_back({std::move(name), std::move(channels),
                             [pixels, put, count](int y, std::span<float> row) {
                               pixels->read(y);
                               for (std::size_t x = 0; x * count < row.size(); ++x)
                                 put(x, &row[x * count]);
                             },
                             storage});
  };
  const auto put_colour = [](const Rgb<double>& c, float* out) {
    out[0] = float(c.r), out[1] = float(c.g), out[2] = float(c.b);
  };
  /// Of all groups together, or of one.
  const auto sum_layer = [&](std::string name, auto value, Storage storage = Storage::colour,
                             int first = 0, int count = 0) {
    const int end = count ? first + count : group_count;
    add_layer(std::move(name), rgb, storage, [=](std::size_t x, float* out) {
      Rgb<double> sum;
      for (int group = first; group < end; ++group) sum += value(pixels->at(x, group));
      put_colour(sum, out);
    });
  };
  const auto mean_layer = [&](const char* name, auto member) {
    add_layer(name, rgb, Storage::colour, [=](std::size_t x, float* out) {
      const PixelSums& p = pixels->at(x);
      put_colour(p.*member * per_sample(p), out);
    });
  };
  const auto number_layer = [&](const char* name, const char* channel, auto member,
                                Storage storage) {
    add_layer(name, {channel}, storage,
              [=](std::size_t x, float* out) { *out = float(pixels->at(x).*member); });
  };
  const auto mean_of = [](auto member) {
    return [member](const PixelSums& p) { return mean_estimate(p).*member; };
  };
  using E = Estimate<double>;
  const auto mean_light_of = [](auto member) {
    return [member](const PixelSums& p) { return p.holdout_light.*member * per_sample(p); };
  };

  sum_layer("beauty", beauty);
  sum_layer("in_scatter", in_scatter);
  sum_layer("surface", surface);
  mean_layer("transmittance", &PixelSums::transmittance);
  if (layout.shadow)
    add_layer("shadow", rgb, Storage::colour,
              [=](std::size_t x, float* out) { put_colour(shadow(pixels->at(x)), out); });
  mean_layer("albedo", &PixelSums::albedo);
  add_layer("normal", {"X", "Y", "Z"}, Storage::colour, [pixels](std::size_t x, float* out) {
    const PixelSums& p = pixels->at(x);
    const Vec3<double> n = p.normal * per_sample(p);
    out[0] = float(n.x), out[1] = float(n.y), out[2] = float(n.z);
  });
  number_layer("depth", "Z", &PixelSums::depth, Storage::single);
  number_layer("object", "id", &PixelSums::object, Storage::id);
  add_layer("standard_error", rgb, Storage::colour, [=](std::size_t x, float* out) {
    const PixelSums& first = pixels->at(x);
    const auto [n0, n1] = first.samples;
    Rgb<double> apart;
    if (n0 > 0 && n1 > 0)
      for (int group = 0; group < group_count; ++group) apart += halves_apart(pixels->at(x, group));
    // Half the difference, with the weights of unequal halves.
    const double scale = n0 > 0 && n1 > 0 ? std::sqrt(n0 * n1) / (n0 + n1) : 0;
    put_colour(Rgb<double>(std::abs(apart.r), std::abs(apart.g), std::abs(apart.b)) * scale, out);
  });
  const auto add_sums = [&](const std::string& prefix, int first, int count) {
    sum_layer(prefix + "plain", mean_of(&E::plain), Storage::single, first, count);
    sum_layer(prefix + "analytic", mean_of(&E::analytic), Storage::single, first, count);
    sum_layer(prefix + "occluded", mean_of(&E::occluded), Storage::single, first, count);
    sum_layer(prefix + "unoccluded", mean_of(&E::unoccluded), Storage::single, first, count);
  };
  if (layout.groups == 1) {
    add_sums("", 0, 1);
  } else {
    if (layout.shadow) {
      sum_layer(
          "holdout_seen", [](const PixelSums& p) { return p.holdouts.seen * per_sample(p); },
          Storage::single, 0, 1);
      sum_layer(
          "holdout_plate", [](const PixelSums& p) { return p.holdouts.plate * per_sample(p); },
          Storage::single, 0, 1);
    }
    // Sums of different groups belong to different quotients.
    for (int group = 0; group < layout.groups; ++group) {
      const std::string name = group ? groups[std::size_t(group)] : "ungrouped";
      sum_layer(name, beauty, Storage::colour, group, 1);
      sum_layer(name + ".in_scatter", in_scatter, Storage::colour, group, 1);
      sum_layer(name + ".surface", surface, Storage::colour, group, 1);
      if (layout.shadow) {
        sum_layer(name + ".holdout_lit", mean_light_of(&HoldoutLight<double>::lit), Storage::single,
                  group, 1);
        sum_layer(name + ".holdout_was_lit", mean_light_of(&HoldoutLight<double>::was_lit),
                  Storage::single, group, 1);
      }
      add_sums(name + ".", group, 1);
    }
  }
  return result;
}

Image Film::layer(const std::string& name) const {
  const Picture whole = picture();
  const auto found = std::ranges::find(whole.layers, name, &Layer::name);
  if (found == whole.layers.end()) throw Error(fmt::format("a picture has no layer \"{}\"", name));
  const int channels = int(found->channels.size());
  Image image(crop.width, crop.height, channels);
  for (int y = 0; y < crop.height; ++y) found->fill(y, image.row(y));
  return image;
}

}  // namespace airlight
