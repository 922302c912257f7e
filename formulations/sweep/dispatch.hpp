#pragma once

#include <string_view>
#include <vector>

#include "formulations/sweep/loops.hpp"
#include "formulations/sweep/sweep.hpp"

namespace sphverify {

/// The loops over pairs of a kernel for this processor. Expects the identifier of a kernel that there is, or of StoredSlope.
template <int Dim>
SweepKernels const& sweep_kernels(std::string_view kernel);

/// Those of one instruction set, for tests; null where the architecture does not have it.
template <int Dim>
SweepKernels const* baseline_kernels(std::string_view kernel);
template <int Dim>
SweepKernels const* avx2_kernels(std::string_view kernel);

/// Adds those of a kernel that is not in KernelList, before any sweep.
void add_kernel_loops(KernelLoops const& loops);

/// Loops made for just one scheme that is not in AllSchemes, with each kernel.
template <int Dim>
std::vector<FusedWithKernel>& added_fused_loops();

}  // namespace sphverify
