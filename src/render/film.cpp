#include "render/film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <set>

#include "error.h"
#include "image/shadow.h"

namespace airlight {
namespace {

std::size_t blocks(int pixels) {
  return std::size_t((pixels + film_block::side - 1) / film_block::side);
}

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

/// Throws Error if two runs share a sample.
void check_disjoint(const SampleRun& a, const SampleRun& b) {
  if (a.seed != b.seed) return;
  for (std::size_t tile = 0; tile < a.counts.size(); ++tile) {
    const std::uint32_t first = std::max(a.first, b.first);
    const std::uint32_t end = std::min(a.first + a.counts[tile], b.first + b.counts[tile]);
    if (first < end)
      throw Error(fmt::format(
          "samples {} to {} of seed {} are there twice; accepted: ranges that do not overlap",
          first, std::min(a.first + a.most(), b.first + b.most()) - 1, a.seed));
  }
}

/// Runs in order, those that follow each other as one.
void add_run(std::vector<SampleRun>& runs, const SampleRun& run) {
  if (run.most() == 0) return;
  std::erase_if(runs, [](const SampleRun& r) { return r.most() == 0; });
  const auto order = [](const SampleRun& r) { return std::pair(r.seed, r.first); };
  runs.insert(std::ranges::upper_bound(runs, order(run), {}, order), run);
  for (std::size_t i = 1; i < runs.size();) {
    SampleRun& before = runs[i - 1];
    const SampleRun& after = runs[i];
    const bool follows = before.seed == after.seed && before.least() == before.most() &&
                         before.first + before.most() == after.first;
    if (!follows) {
      ++i;
      continue;
    }
    std::ranges::transform(before.counts, after.counts, before.counts.begin(), std::plus());
    runs.erase(runs.begin() + std::ptrdiff_t(i));
  }
}

}  // namespace

Estimate<double> mean_estimate(const PixelSums& pixel) {
  Estimate<double> sum = pixel.in_scatter[0];
  sum += pixel.in_scatter[1];
  return sum * per_sample(pixel);
}

std::string part_of(const Film& film) {
  return fmt::format("{} x {} pixels at {},{} of {} x {}", film.crop.width, film.crop.height,
                     film.crop.x0, film.crop.y0, film.full.width, film.full.height);
}

Film::Film(Resolution full_, PixelRect crop_) : Film(full_, crop_, {}, {""}) {}

Film::Film(Resolution full_, PixelRect crop_, FilmLayout layout_, std::vector<std::string> groups_)
    : full(full_),
      crop(crop_),
      layout(layout_),
      groups(std::move(groups_)),
      blocks_across_(blocks(crop_.width)),
      sums_(blocks_across_ * blocks(crop_.height) * film_block::pixels *
            std::size_t(layout.sums())),
      features_(sums_.size() / std::size_t(layout.sums()) * std::size_t(layout.features())),
      samples_(sums_.size() / std::size_t(layout.sums()) * 2) {}

Film::Place Film::place(int x, int y) const noexcept {
  constexpr int side = film_block::side;
  return {std::size_t(y / side) * blocks_across_ + std::size_t(x / side),
          film_block::index(x % side, y % side)};
}

Film::Place Film::place(std::size_t index) const noexcept {
  return place(int(index % std::size_t(crop.width)), int(index / std::size_t(crop.width)));
}

int Film::tile_count() const noexcept {
  const auto tiles = [](int pixels) { return (pixels + tile_side - 1) / tile_side; };
  return tiles(crop.width) * tiles(crop.height);
}

PixelRect Film::tile(int index) const noexcept {
  const int across = (crop.width + tile_side - 1) / tile_side;
  const int x = index % across * tile_side, y = index / across * tile_side;
  return {x, y, std::min(tile_side, crop.width - x), std::min(tile_side, crop.height - y)};
}

template <class Self, class Visit>
void Film::for_each_piece(Self& film, int index, Visit&& visit) {
  const PixelRect rect = film.tile(index);
  const std::size_t across = blocks(rect.width) * film_block::pixels;
  for (int y = rect.y0; y < rect.y0 + rect.height; y += film_block::side) {
    const std::size_t first = film.place(rect.x0, y).block * film_block::pixels;
    const auto rows = [&](auto& numbers, int count) {
      visit(&numbers[first * std::size_t(count)], across * std::size_t(count));
    };
    rows(film.sums_, film.layout.sums());
    rows(film.features_, film.layout.features());
    rows(film.samples_, 2);
  }
}

std::size_t Film::tile_bytes(int index) const noexcept {
  std::size_t bytes = 0;
  for_each_piece(*this, index,
                 [&](const auto* numbers, std::size_t count) { bytes += count * sizeof *numbers; });
  return bytes;
}

void Film::save_tile(int index, std::byte* to) const noexcept {
  for_each_piece(*this, index, [&](const auto* numbers, std::size_t count) {
    std::memcpy(to, numbers, count * sizeof *numbers);
    to += count * sizeof *numbers;
  });
}

void Film::load_tile(int index, const std::byte* from) noexcept {
  for_each_piece(*this, index, [&](auto* numbers, std::size_t count) {
    std::memcpy(numbers, from, count * sizeof *numbers);
    from += count * sizeof *numbers;
  });
}

FilmPixels Film::at(int x, int y) noexcept {
  const auto [block, index] = place(x, y);
  const std::size_t rows = block * film_block::pixels;
  return {sums_.data() + rows * std::size_t(layout.sums()) + index,
          features_.data() + rows * std::size_t(layout.features()) + index,
          samples_.data() + rows * 2 + index};
}

PixelSums Film::pixel(std::size_t pixel, int group) const {
  const auto [block, index] = place(pixel);
  const auto row = [&](const auto& numbers, int rows, int i) {
    return double(numbers[(block * std::size_t(rows) + std::size_t(i)) * film_block::pixels +
                          std::size_t(index)]);
  };
  const auto colour = [&](const auto& numbers, int rows, int i) {
    return Rgb<double>(row(numbers, rows, i), row(numbers, rows, i + 1), row(numbers, rows, i + 2));
  };
  const auto estimate = [&](const auto& numbers, int rows, int i) {
    Estimate<double> e;
    if (layout.plain) e.plain = colour(numbers, rows, i), i += 3;
    if (layout.ratio) {
      e.analytic = colour(numbers, rows, i);
      e.occluded = colour(numbers, rows, i + 3);
      e.unoccluded = colour(numbers, rows, i + 6);
    }
    return e;
  };
  const int sums = layout.sums(), features = layout.features();
  PixelSums result;
  result.in_scatter[1] = estimate(features_, features, layout.second_half(group));
  result.in_scatter[0] = result.in_scatter[1] * -1.;
  result.in_scatter[0] += estimate(sums_, sums, layout.in_scatter(group));
  result.samples = {row(samples_, 2, 0), row(samples_, 2, 1)};
  result.surface = colour(sums_, sums, layout.surface(group));
  result.transmittance = colour(features_, features, FilmLayout::transmittance);
  result.albedo = colour(features_, features, FilmLayout::albedo);
  if (layout.shadow) {
    result.holdouts = {colour(features_, features, layout.holdouts()),
                       group == 0 ? colour(sums_, sums, layout.plate()) : Rgb<double>()};
    HoldoutLight<double> all;
    for (int g = 0; g < layout.groups; ++g) {
      const int first = layout.holdout_light(g);
      const HoldoutLight<double> light{colour(features_, features, first),
                                       colour(features_, features, first + 3)};
      if (g == group) result.holdout_light = light;
      all += light;
    }
    result.shadow = all.shadow();
  }
  const Rgb<double> normal = colour(features_, features, FilmLayout::normal);
  result.normal = {normal.r, normal.g, normal.b};
  result.depth = row(features_, features, FilmLayout::depth);
  result.object = row(features_, features, FilmLayout::object);
  return result;
}

void Film::merge(const Film& other) {
  if (part_of(*this) != part_of(other))
    throw Error(
        fmt::format("{} and {} cannot be merged; accepted: the same part of the same picture",
                    part_of(*this), part_of(other)));
  if (layout != other.layout || groups != other.groups)
    throw Error(
        "films of other sums or light groups cannot be merged; accepted: those of one scene and "
        "one estimator");
  for (const SampleRun& run : other.runs)
    for (const SampleRun& own : runs) check_disjoint(own, run);
  // Depth and object stay those of the first film that has samples.
  constexpr std::size_t width = film_block::pixels;
  const std::size_t features = std::size_t(layout.features());
  for (std::size_t i = 0; i < features_.size(); ++i) {
    const std::size_t feature = i / width % features;
    const bool adds = feature < FilmLayout::added || feature > FilmLayout::object;
    const std::size_t samples = i / (width * features) * 2 * width + i % width;
    if (adds)
      features_[i] += other.features_[i];
    else if (samples_[samples] + samples_[samples + width] == 0)
      features_[i] = other.features_[i];
  }
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i] += other.samples_[i];
  for (const SampleRun& run : other.runs) add_run(runs, run);
}

Rgb<double> Film::radiance(int x, int y) const {
  const std::size_t index = std::size_t(y) * std::size_t(crop.width) + std::size_t(x);
  Rgb<double> sum;
  for (int group = 0; group < layout.groups; ++group) sum += beauty(pixel(index, group));
  return sum;
}

std::int64_t Film::samples() const {
  std::int64_t sum = 0;
  for (const SampleRun& run : runs) sum += run.least();
  return sum;
}

std::int64_t Film::most_samples() const {
  auto sums = std::vector<std::int64_t>(std::size_t(tile_count()));
  for (const SampleRun& run : runs)
    std::ranges::transform(sums, run.counts, sums.begin(), std::plus());
  return std::ranges::max(sums);
}

namespace {

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
