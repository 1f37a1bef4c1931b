// Compiled once for each wider instruction set, which sets the entry's name; all else in the object
// is hidden.
#include "render/tile_kernel.h"

extern "C" const airlight::Kernel* AIRLIGHT_ENTRY() {
  static constexpr airlight::Kernel kernel = airlight::make_kernel<airlight::FloatBatch>(
      airlight::InstructionSet::AIRLIGHT_ISA, AIRLIGHT_ISA_NAME);
  return &kernel;
}
