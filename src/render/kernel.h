#pragma once
#include <span>
#include <vector>

#include "render/frame.h"

namespace airlight {

/// What is compiled once for each arithmetic. The reference is double; all others are float.
struct Kernel {
  InstructionSet isa;
  const char* name;
  int lanes;

  /// Adds the tile's samples to its sums.
  void (*render)(const Frame& frame, Tile& tile);

  /// Origins and directions of `count` rays as six arrays of floats, to T of a box for light from
  /// `toward`; the closed form by itself, for programs that have their own renderer around it and
  /// for the benchmarks.  [m]
  void (*transmittance_integrals)(const Box& box, Vec3<double> toward, double sigma_t,
                                  std::size_t count, const float* const rays[6], float* integrals);
};

/// The kernel of an instruction set; throws Error with what the machine has if it lacks it.
const Kernel& kernel_for(InstructionSet isa);

/// The kernels this machine can run, the reference first, the widest last.
std::vector<const Kernel*> available_kernels();

}  // namespace airlight
