#include "render/tile_kernel.h"

namespace airlight {

extern const Kernel kernel_double = make_kernel<double>(InstructionSet::reference, "double");

}  // namespace airlight
