#include "render/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "error.h"

namespace airlight {
namespace {

std::size_t blocks(int pixels) {
  return std::size_t((pixels + film_block::side - 1) / film_block::side);
}

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

}  // namespace airlight
