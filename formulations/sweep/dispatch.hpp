#pragma once

#include <string_view>

#include "formulations/sweep/sweep.hpp"

namespace sphverify {

/// The loops over pairs of a kernel for this processor. Expects the identifier of one of KernelList.
template <int Dim>
SweepKernels const& sweep_kernels(std::string_view kernel);

/// Those of one instruction set, for tests; null where the architecture does not have it.
template <int Dim>
SweepKernels const* baseline_kernels(std::string_view kernel);
template <int Dim>
SweepKernels const* avx2_kernels(std::string_view kernel);

}  // namespace sphverify
