#include "formulations/sweep/dispatch.hpp"

#include "formulations/simd/instruction_set.hpp"

namespace sphverify {

extern SweepKernels const baseline_kernels[3];
#if defined(__x86_64__)
extern SweepKernels const avx2_kernels[3];
#endif

template <int Dim>
SweepKernels const& sweep_kernels() {
#if defined(__x86_64__)
  static bool const has_avx2 = processor_has_avx2();
  if (has_avx2) return avx2_kernels[Dim - 1];
#endif
  return baseline_kernels[Dim - 1];
}

template SweepKernels const& sweep_kernels<1>();
template SweepKernels const& sweep_kernels<2>();
template SweepKernels const& sweep_kernels<3>();

}  // namespace sphverify
