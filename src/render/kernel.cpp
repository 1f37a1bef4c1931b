#include "render/kernel.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace airlight {

extern const Kernel kernel_double;
extern const Kernel kernel_float;
extern const Kernel kernel_baseline;
extern "C" const Kernel* airlight_kernel_avx2();
extern "C" const Kernel* airlight_kernel_avx512();

std::vector<const Kernel*> available_kernels() {
  std::vector<const Kernel*> kernels = {&kernel_double, &kernel_float, &kernel_baseline};
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx2) kernels.push_back(airlight_kernel_avx2());
  if (avx512) kernels.push_back(airlight_kernel_avx512());
  return kernels;
}

const Kernel& kernel_for(InstructionSet isa) {
  const std::vector<const Kernel*> kernels = available_kernels();
  if (isa == InstructionSet::best) return *kernels.back();
  const auto found = std::ranges::find(kernels, isa, &Kernel::isa);
  if (found != kernels.end()) return **found;
  std::string names;
  for (const Kernel* kernel : kernels)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", kernel->name);
  throw Error(
      fmt::format("isa: this machine has no such instructions; accepted here: best, {}", names));
}

}  // namespace airlight
