#include "render/tile_kernel.h"

namespace airlight {

extern const Kernel kernel_baseline = make_kernel<FloatBatch>(InstructionSet::baseline, "baseline");

}  // namespace airlight
