#pragma once

#include "formulations/sweep/sweep.hpp"

namespace sphverify {

/// The loops over pairs, for this processor.
template <int Dim>
SweepKernels const& sweep_kernels();

}  // namespace sphverify
