// SPDX-License-Identifier: GPL-3.0-or-later
#include "formulations/neighbours/list_dispatch.hpp"

#include "formulations/simd/instruction_set.hpp"

namespace sphverify {

extern ListKernels const baseline_list_kernels[3];
#if defined(__x86_64__)
extern ListKernels const avx2_list_kernels[3];
#endif

template <int Dim>
ListKernels const& list_kernels() {
#if defined(__x86_64__)
  static bool const has_avx2 = processor_has_avx2();
  if (has_avx2) return avx2_list_kernels[Dim - 1];
#endif
  return baseline_list_kernels[Dim - 1];
}

template ListKernels const& list_kernels<1>();
template ListKernels const& list_kernels<2>();
template ListKernels const& list_kernels<3>();

}  // namespace sphverify
