// SPDX-License-Identifier: GPL-3.0-or-later
#define SPHVERIFY_INSTRUCTION_SET baseline
#include "formulations/neighbours/list_kernels.hpp"

namespace sphverify {

extern constinit ListKernels const baseline_list_kernels[3] = {
    baseline::make_list_kernels<1>(), baseline::make_list_kernels<2>(), baseline::make_list_kernels<3>()};

}  // namespace sphverify
