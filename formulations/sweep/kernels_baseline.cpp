#define SPHVERIFY_INSTRUCTION_SET baseline
#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/sweep/kernels.hpp"

namespace sphverify {

extern constinit SweepKernels const baseline_kernels[3] = {
    baseline::make_kernels<1, CubicSpline<1>>(static_cast<AllSchemes const*>(nullptr), "baseline"),
    baseline::make_kernels<2, CubicSpline<2>>(static_cast<AllSchemes const*>(nullptr), "baseline"),
    baseline::make_kernels<3, CubicSpline<3>>(static_cast<AllSchemes const*>(nullptr), "baseline")};

}  // namespace sphverify
