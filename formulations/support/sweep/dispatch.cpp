#include "formulations/support/sweep/dispatch.hpp"

namespace sphverify {

extern SweepKernels const baseline_kernels[3];
#if defined(__x86_64__)
extern SweepKernels const avx2_kernels[3];
#endif

namespace {

SweepKernels const* choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2_kernels;
#endif
  return baseline_kernels;
}

}  // namespace

template <int Dim>
SweepKernels const& sweep_kernels() {
  static SweepKernels const* const chosen = choose();
  return chosen[Dim - 1];
}

template SweepKernels const& sweep_kernels<1>();
template SweepKernels const& sweep_kernels<2>();
template SweepKernels const& sweep_kernels<3>();

}  // namespace sphverify
