#if defined(__AVX2__)
#define SPHVERIFY_INSTRUCTION_SET avx2
#include "formulations/kernels/cubic_spline.hpp"
#include "formulations/sweep/kernels.hpp"

namespace sphverify {

extern constinit SweepKernels const avx2_kernels[3] = {
    avx2::make_kernels<1, CubicSpline<1>>(static_cast<AllSchemes const*>(nullptr), "avx2"),
    avx2::make_kernels<2, CubicSpline<2>>(static_cast<AllSchemes const*>(nullptr), "avx2"),
    avx2::make_kernels<3, CubicSpline<3>>(static_cast<AllSchemes const*>(nullptr), "avx2")};

}  // namespace sphverify
#endif
