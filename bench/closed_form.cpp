#include "closed_form.h"

#include <fmt/format.h>

#include "measure.h"
#include "render/kernel.h"

namespace airlight::bench {
namespace {

/// The rays of a 640 x 360 picture of the box [-1, 1]^3 from a little above and in front.
struct Rays {
  static constexpr int width = 640, height = 360;
  std::vector<float> parts[6];

  Rays() {
    const Vec3<double> eye(0, 0.2, 3.1);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Vec3<double> d =
            normalize(Vec3<double>((x + 0.5) / width - 0.5, 0.28 - 0.56 * (y + 0.5) / height, -1));
        const double values[6] = {eye.x, eye.y, eye.z, d.x, d.y, d.z};
        for (int k = 0; k < 6; ++k) parts[k].push_back(float(values[k]));
      }
  }
};

}  // namespace

std::vector<Row> closed_form() {
  const Rays rays;
  const float* const parts[6] = {rays.parts[0].data(), rays.parts[1].data(), rays.parts[2].data(),
                                 rays.parts[3].data(), rays.parts[4].data(), rays.parts[5].data()};
  std::vector<float> integrals(rays.parts[0].size());
  const Vec3<double> toward = normalize(Vec3<double>(1, 1, -0.2));
  const auto frame = [&](const Kernel& kernel) {
    return [&] {
      kernel.transmittance_integrals(Box{}, toward, 1, integrals.size(), parts, integrals.data());
      keep(integrals[0]);
    };
  };

  struct Bound {
    InstructionSet isa;
    double nanoseconds, times_scalar;
  };
  const Bound bounds[] = {{InstructionSet::avx2, 16, 4}, {InstructionSet::avx512, 8, 7}};
  const Kernel& scalar = kernel_for(InstructionSet::scalar);
  const Pin pin;
  std::vector<Row> rows;
  for (const Bound& bound : bounds)
    for (const Kernel* kernel : available_kernels()) {
      if (kernel->isa != bound.isa) continue;
      const double one = median_seconds(101, frame(*kernel)) / double(integrals.size());
      rows.push_back({fmt::format("closed_form.{}", kernel->name), one * 1e9, "ns a ray",
                      Must::at_most(bound.nanoseconds), kernel->name});
      rows.push_back({fmt::format("closed_form.{}_over_scalar", kernel->name),
                      median_ratio(31, frame(scalar), frame(*kernel)), "x",
                      Must::at_least(bound.times_scalar), kernel->name});
    }
  return rows;
}

}  // namespace airlight::bench
