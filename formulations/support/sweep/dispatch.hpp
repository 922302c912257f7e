#pragma once

#include "formulations/support/sweep/sweep.hpp"

namespace sphverify {

struct ListKernels;

/// The loops over pairs for this processor, chosen once, at the first call: AVX2 with fused multiply-add
/// where an x86-64 has both, else what every machine of the architecture has. Results of the two differ by
/// round-off.
template <int Dim>
SweepKernels const& sweep_kernels();

/// The loops that find neighbours, chosen likewise.
template <int Dim>
ListKernels const& list_kernels();

}  // namespace sphverify
