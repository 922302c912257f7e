#define SPHVERIFY_INSTRUCTION_SET baseline
#include "formulations/sweep/kernels.hpp"

namespace sphverify {

extern constinit SweepKernels const baseline_kernels[3] = {
    baseline::make_kernels<1>(static_cast<AllSchemes const*>(nullptr), "baseline"),
    baseline::make_kernels<2>(static_cast<AllSchemes const*>(nullptr), "baseline"),
    baseline::make_kernels<3>(static_cast<AllSchemes const*>(nullptr), "baseline")};

}  // namespace sphverify
