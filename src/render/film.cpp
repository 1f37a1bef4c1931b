#include "render/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"

namespace airlight {

template <class Real>
template <class Other>
void PixelSums<Real>::add(const std::array<Other, count>& other) {
  const bool first = !(sample_count() > 0);
  Row mine = row();
  for (std::size_t i = 0; i < added; ++i) mine[i] += Real(other[i]);
  if (first)
    for (std::size_t i = added; i < count; ++i) mine[i] = Real(other[i]);
  *this = std::bit_cast<PixelSums>(mine);
}

template void PixelSums<float>::add(const std::array<float, count>&);
template void PixelSums<float>::add(const std::array<double, count>&);

Film::Film(Resolution full_, PixelRect crop_)
    : full(full_), crop(crop_), pixels(std::size_t(crop_.width) * std::size_t(crop_.height)) {}

void Film::merge(const Film& other) {
  const auto place = [](const Film& film) {
    return fmt::format("{} x {} pixels at {},{} of {} x {}", film.crop.width, film.crop.height,
                       film.crop.x0, film.crop.y0, film.full.width, film.full.height);
  };
  if (place(*this) != place(other))
    throw Error(
        fmt::format("{} and {} cannot be merged; accepted: the same part of the same picture",
                    place(*this), place(other)));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(other.pixels[i].row());
}

namespace {

double per_sample(const PixelSums<float>& pixel) {
  const double n = pixel.sample_count();
  return n > 0 ? 1 / n : 0;
}

Rgb<double> in_scatter(const PixelSums<float>& pixel) { return mean_estimate(pixel).radiance(); }

/// From the two halves, each with its own quotient: half their difference, with the weights of
/// unequal halves.
Rgb<double> standard_error(const PixelSums<float>& pixel) {
  const double n0 = pixel.samples[0], n1 = pixel.samples[1];
  if (!(n0 > 0) || !(n1 > 0)) return {};
  const auto half = [&](int i) {
    Estimate<double> sums;
    sums.plain = Rgb<double>(pixel.in_scatter[i].plain);
    sums.analytic = Rgb<double>(pixel.in_scatter[i].analytic);
    sums.occluded = Rgb<double>(pixel.in_scatter[i].occluded);
    sums.unoccluded = Rgb<double>(pixel.in_scatter[i].unoccluded);
    return (sums * (1 / double(pixel.samples[i]))).radiance();
  };
  const Rgb<double> d = half(0) - half(1);
  const double scale = std::sqrt(n0 * n1) / (n0 + n1);
  return Rgb<double>(std::abs(d.r), std::abs(d.g), std::abs(d.b)) * scale;
}

const std::vector<std::string> rgb = {"R", "G", "B"};

}  // namespace

Estimate<double> mean_estimate(const PixelSums<float>& pixel) {
  Estimate<double> sum;
  for (const Estimate<float>& half : pixel.in_scatter) {
    sum.plain += Rgb<double>(half.plain);
    sum.analytic += Rgb<double>(half.analytic);
    sum.occluded += Rgb<double>(half.occluded);
    sum.unoccluded += Rgb<double>(half.unoccluded);
  }
  return sum * per_sample(pixel);
}

Rgb<double> Film::radiance(int x, int y) const {
  const PixelSums<float>& pixel = pixels[std::size_t(y) * std::size_t(crop.width) + std::size_t(x)];
  return in_scatter(pixel) + Rgb<double>(pixel.surface) * per_sample(pixel);
}

Picture Film::picture() const {
  Picture result;
  result.width = crop.width;
  result.height = crop.height;
  if (crop.width != full.width || crop.height != full.height)
    result.crop = Crop{crop.x0, crop.y0, full.width, full.height};

  const auto row_of = [this](int y) { return &pixels[std::size_t(y) * std::size_t(crop.width)]; };
  const auto colour_layer = [&](const char* name, auto value, Storage storage = Storage::colour) {
    result.layers.push_back({name, rgb,
                             [this, row_of, value](int y, std::span<float> row) {
                               for (int x = 0; x < crop.width; ++x) {
                                 const Rgb<double> c = value(row_of(y)[x]);
                                 row[3 * x] = float(c.r), row[3 * x + 1] = float(c.g),
                                         row[3 * x + 2] = float(c.b);
                               }
                             },
                             storage});
  };
  const auto mean = [](auto member) {
    return [member](const PixelSums<float>& p) { return Rgb<double>(p.*member) * per_sample(p); };
  };
  const auto sum = [](auto member) {
    return [member](const PixelSums<float>& p) { return mean_estimate(p).*member; };
  };
  using P = PixelSums<float>;
  using E = Estimate<double>;

  colour_layer("beauty",
               [](const P& p) { return in_scatter(p) + Rgb<double>(p.surface) * per_sample(p); });
  colour_layer("in_scatter", in_scatter);
  colour_layer("surface", mean(&P::surface));
  colour_layer("transmittance", mean(&P::transmittance));
  colour_layer("albedo", mean(&P::albedo));
  result.layers.push_back({"normal",
                           {"X", "Y", "Z"},
                           [this, row_of](int y, std::span<float> row) {
                             for (int x = 0; x < crop.width; ++x) {
                               const P& p = row_of(y)[x];
                               const Vec3<double> n = Vec3<double>(p.normal) * per_sample(p);
                               row[3 * x] = float(n.x), row[3 * x + 1] = float(n.y),
                                       row[3 * x + 2] = float(n.z);
                             }
                           },
                           Storage::colour});
  const auto number_layer = [&](const char* name, const char* channel, auto member,
                                Storage storage) {
    result.layers.push_back({name,
                             {channel},
                             [this, row_of, member](int y, std::span<float> row) {
                               for (int x = 0; x < crop.width; ++x) row[x] = row_of(y)[x].*member;
                             },
                             storage});
  };
  number_layer("depth", "Z", &P::depth, Storage::single);
  number_layer("object", "id", &P::object, Storage::id);
  colour_layer("standard_error", standard_error);
  colour_layer("plain", sum(&E::plain), Storage::single);
  colour_layer("analytic", sum(&E::analytic), Storage::single);
  colour_layer("occluded", sum(&E::occluded), Storage::single);
  colour_layer("unoccluded", sum(&E::unoccluded), Storage::single);
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
