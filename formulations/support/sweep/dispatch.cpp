#include "formulations/support/sweep/dispatch.hpp"

#include "formulations/support/sweep/candidates.hpp"

namespace sphverify {

extern SweepKernels const baseline_kernels[3];
extern ListKernels const baseline_list_kernels[3];
#if defined(__x86_64__)
extern SweepKernels const avx2_kernels[3];
extern ListKernels const avx2_list_kernels[3];
#endif

namespace {

/// The loops of one instruction set, per dimension.
struct Kernels {
  SweepKernels const* sweep;
  ListKernels const* list;
};

Kernels choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return {avx2_kernels, avx2_list_kernels};
#endif
  return {baseline_kernels, baseline_list_kernels};
}

Kernels const& chosen() {
  static Kernels const once = choose();
  return once;
}

}  // namespace

template <int Dim>
SweepKernels const& sweep_kernels() {
  return chosen().sweep[Dim - 1];
}
template <int Dim>
ListKernels const& list_kernels() {
  return chosen().list[Dim - 1];
}

#define SPHVERIFY_INSTANTIATE(Dim)                   \
  template SweepKernels const& sweep_kernels<Dim>(); \
  template ListKernels const& list_kernels<Dim>();
SPHVERIFY_INSTANTIATE(1)
SPHVERIFY_INSTANTIATE(2)
SPHVERIFY_INSTANTIATE(3)
#undef SPHVERIFY_INSTANTIATE

}  // namespace sphverify
