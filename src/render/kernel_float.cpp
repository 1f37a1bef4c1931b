#include "render/tile_kernel.h"

namespace airlight {

extern const Kernel kernel_float = make_kernel<float>(InstructionSet::scalar, "scalar");

}  // namespace airlight
