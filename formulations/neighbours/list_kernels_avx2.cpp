// SPDX-License-Identifier: GPL-3.0-or-later
#if defined(__AVX2__)
#define SPHVERIFY_INSTRUCTION_SET avx2
#include "formulations/neighbours/list_kernels.hpp"

namespace sphverify {

extern constinit ListKernels const avx2_list_kernels[3] = {
    avx2::make_list_kernels<1>(), avx2::make_list_kernels<2>(), avx2::make_list_kernels<3>()};

}  // namespace sphverify
#endif
