#include <cmath>

#include "box_transmittance_kernel.h"
#include "measure.h"
#include "row.h"

namespace airlight::bench {
namespace {

/// Camera rays that all meet the box, as many as stay in the second cache with their answers.
class Tile {
 public:
  Tile() : x_(count), y_(count), z_(count), integral_(count) {
    for (int i = 0; i < count; ++i) {
      const double u = (i % side + 0.5) / side - 0.5, v = (i / side + 0.5) / side - 0.5;
      const double length = std::sqrt(u * u * 0.36 + v * v * 0.36 + 1);
      x_[i] = float(0.6 * u / length), y_[i] = float(0.6 * v / length), z_[i] = float(1 / length);
    }
  }

  BoxRays rays() {
    return {{0.1, 0.2, -3}, {0.48, 0.6, -0.64}, 0.7,   x_.data(),
            y_.data(),      z_.data(),          count, integral_.data()};
  }

  static constexpr int side = 64, count = side * side;

 private:
  std::vector<float> x_, y_, z_, integral_;
};

struct Kernel {
  const char* isa;
  BoxTransmittance* run;
  bool there;  ///< whether this machine has the instructions
  Must ns, gain;
};

constexpr int tiles = 40;  // a run: 164 thousand rays, about a millisecond

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}

std::vector<Row> measure() {
  const Pin pin;
  Tile tile;
  const BoxRays rays = tile.rays();
  const auto run = [&rays](BoxTransmittance* kernel, bool one_lane) {
    return [&rays, kernel, one_lane] {
      for (int i = 0; i < tiles; ++i) {
        kernel(rays, one_lane);
        keep(*rays.integral);
      }
    };
  };
  const Kernel kernels[] = {
      {"baseline", airlight_box_transmittance_baseline, true, {}, {}},
      {"avx2", airlight_box_transmittance_avx2, has_avx2(), Must::at_most(16), Must::at_least(4)},
      {"avx512", airlight_box_transmittance_avx512, has_avx512(), Must::at_most(8),
       Must::at_least(7)},
  };
  std::vector<Row> rows;
  for (const Kernel& kernel : kernels) {
    if (!kernel.there) continue;
    const std::string name = std::string("box_transmittance.") + kernel.isa;
    const double ns = median_seconds(51, run(kernel.run, false)) * 1e9 / (tiles * Tile::count);
    const double gain = median_ratio(15, run(kernel.run, true), run(kernel.run, false));
    rows.push_back({name, ns, "ns a ray", kernel.ns, kernel.isa});
    rows.push_back({name + ".gain", gain, "x one lane", kernel.gain, kernel.isa});
  }
  return rows;
}

}  // namespace

Bench box_transmittance() {
  return {"box_transmittance",
          "closed-form T of a box on one core, and its gain over one lane of floats", measure};
}

}  // namespace airlight::bench
