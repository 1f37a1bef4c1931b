#include "scene/objects/depth_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace airlight {
namespace {

/// One over the depth, which planes interpolate linearly over the picture, of every pixel and of
/// one more all around; 0: nothing is there.
class InverseDepths {
 public:
  InverseDepths(const Image& depths, double discontinuity)
      : width(depths.width + 2),
        height(depths.height + 2),
        least_ratio_(1 / (1 + discontinuity)),
        values_(std::size_t(width) * std::size_t(height)) {
    for (int y = 1; y < height - 1; ++y)
      for (int x = 1; x < width - 1; ++x)
        if (const double depth = depths.at(x - 1, y - 1, 0); depth > 0) at(x, y) = 1 / depth;
    for (int y = 1; y < height - 1; ++y) {
      at(0, y) = carried_on(at(1, y), at(2, y));
      at(width - 1, y) = carried_on(at(width - 2, y), at(width - 3, y));
    }
    for (int x = 0; x < width; ++x) {
      at(x, 0) = carried_on(at(x, 1), at(x, 2));
      at(x, height - 1) = carried_on(at(x, height - 2), at(x, height - 3));
    }
  }

  int width, height;  ///< with the pixels around

  /// 0 outside.
  double operator()(int x, int y) const {
    return x < 0 || y < 0 || x >= width || y >= height
               ? 0
               : values_[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }

  /// Whether two neighbours belong to one surface.
  bool joined(double a, double b) const {
    return std::min(a, b) > 0 && std::min(a, b) >= least_ratio_ * std::max(a, b);
  }

 private:
  double& at(int x, int y) { return values_[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }

  /// The value after `last` of a row that ends with `before`, `last`: on the same plane, if they
  /// are on one surface.
  double carried_on(double last, double before) const {
    const double next = 2 * last - before;
    return joined(last, before) && joined(last, next) ? next : last;
  }

  double least_ratio_;
  std::vector<double> values_;
};

class Builder {
 public:
  Builder(const Image& depths, const CameraFrame& frame, double discontinuity)
      : picture_{depths.width, depths.height}, frame_(frame), pixels_(depths, discontinuity) {}

  Mesh mesh() {
    corners_.reserve(std::size_t(pixels_.width + 1) * std::size_t(pixels_.height + 1));
    for (int y = 0; y <= pixels_.height; ++y)
      for (int x = 0; x <= pixels_.width; ++x) corners_.push_back(vertices_at(x, y));
    for (int y = 0; y < pixels_.height; ++y)
      for (int x = 0; x < pixels_.width; ++x) add_pixel(x, y);
    return std::move(mesh_);
  }

 private:
  /// A corner's vertices, one for each of the pixels that meet there, from the upper left one on
  /// clockwise.
  using Vertices = std::array<std::uint32_t, 4>;

  /// At the upper left corner of the pixel (x, y). Pixels that are joined share a vertex.
  Vertices vertices_at(int x, int y) {
    const std::array<double, 4> around = {pixels_(x - 1, y - 1), pixels_(x, y - 1), pixels_(x, y),
                                          pixels_(x - 1, y)};
    Vertices result{};
    std::array<bool, 4> done{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (done[i] || !(around[i] > 0)) continue;
      std::array<bool, 4> together{};
      together[i] = true;
      for (const std::size_t step : {1, 3})  // clockwise, then back
        for (std::size_t k = i, next;
             next = (k + step) % 4, !together[next] && pixels_.joined(around[k], around[next]);
             k = next)
          together[next] = true;
      double sum = 0;
      int count = 0;
      for (std::size_t k = 0; k < 4; ++k)
        if (together[k]) sum += around[k], ++count;
      const std::uint32_t vertex = add_vertex(x - 1, y - 1, sum / count);
      for (std::size_t k = 0; k < 4; ++k)
        if (together[k]) result[k] = vertex, done[k] = true;
    }
    return result;
  }

  /// At picture coordinates.
  std::uint32_t add_vertex(int x, int y, double inverse) {
    mesh_.positions.emplace_back(frame_.position + frame_.direction(x, y) * (1 / inverse));
    mesh_.uvs.push_back({float(x) / float(picture_.width), 1 - float(y) / float(picture_.height)});
    inverse_.push_back(inverse);
    return std::uint32_t(inverse_.size() - 1);
  }

  void add_pixel(int x, int y) {
    const double own = pixels_(x, y);
    if (!(own > 0)) return;
    const auto corner = [&](int i, int j, std::size_t seen_from) {
      return corners_[std::size_t(j) * std::size_t(pixels_.width + 1) + std::size_t(i)][seen_from];
    };
    const std::array<std::uint32_t, 4> v = {corner(x, y, 2), corner(x + 1, y, 3),
                                            corner(x + 1, y + 1, 0), corner(x, y + 1, 1)};
    // Along the diagonal whose middle is nearer to what the pixel says.
    const auto off = [&](std::size_t a, std::size_t b) {
      return std::abs((inverse_[v[a]] + inverse_[v[b]]) / 2 - own);
    };
    if (off(0, 2) <= off(1, 3))
      mesh_.triangles.insert(mesh_.triangles.end(), {{v[0], v[1], v[2]}, {v[0], v[2], v[3]}});
    else
      mesh_.triangles.insert(mesh_.triangles.end(), {{v[0], v[1], v[3]}, {v[1], v[2], v[3]}});
  }

  Resolution picture_;
  const CameraFrame& frame_;
  InverseDepths pixels_;
  std::vector<Vertices> corners_;
  std::vector<double> inverse_;  ///< of the vertices
  Mesh mesh_;
};

}  // namespace

Mesh depth_surface(const Image& depths, const CameraFrame& frame, double discontinuity) {
  return Builder(depths, frame, discontinuity).mesh();
}

}  // namespace airlight
