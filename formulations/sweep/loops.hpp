#pragma once

#include <array>
#include <span>
#include <string_view>

#include "formulations/simd/instruction_set.hpp"
#include "formulations/sweep/sweep.hpp"

// The loops over pairs by name. Their code is compiled once per instruction set (scheme_loops.hpp, kernels.hpp); which set
// runs is chosen here.
namespace sphverify {

namespace baseline {
template <class Scheme, int Dim>
SchemeLoops const& scheme_loops();
template <class Scheme, int Dim>
std::span<FusedWithKernel const> fused_with_kernels();
template <template <int> class Kernel, int Dim, class Schemes>
SweepKernels const& loops();
}  // namespace baseline

namespace avx2 {
template <class Scheme, int Dim>
SchemeLoops const& scheme_loops();
template <class Scheme, int Dim>
std::span<FusedWithKernel const> fused_with_kernels();
template <template <int> class Kernel, int Dim, class Schemes>
SweepKernels const& loops();
}  // namespace avx2

/// Those of a scheme for this processor.
template <class Scheme, int Dim>
SchemeLoops const& loops_of_scheme() {
  if constexpr (architecture_may_have_avx2) {
    if (processor_has_avx2()) return avx2::scheme_loops<Scheme, Dim>();
  }
  return baseline::scheme_loops<Scheme, Dim>();
}

/// Per kernel of ours the loops that were made for just this scheme, for this processor.
template <class Scheme, int Dim>
std::span<FusedWithKernel const> fused_loops_of_scheme() {
  if constexpr (architecture_may_have_avx2) {
    if (processor_has_avx2()) return avx2::fused_with_kernels<Scheme, Dim>();
  }
  return baseline::fused_with_kernels<Scheme, Dim>();
}

/// Those of a kernel in 1, 2 and 3 dimensions, by instruction set; null for a set that the architecture does not have.
struct KernelLoops {
  using InDimension = SweepKernels const& (*)();
  std::string_view kernel;
  std::array<InDimension, 3> baseline{}, avx2{};
};

template <template <int> class Kernel, class Schemes>
KernelLoops loops_of_kernel() {
  KernelLoops found{Kernel<1>::id,
                    {baseline::loops<Kernel, 1, Schemes>, baseline::loops<Kernel, 2, Schemes>,
                     baseline::loops<Kernel, 3, Schemes>}};
  if constexpr (architecture_may_have_avx2) {
    found.avx2 = {avx2::loops<Kernel, 1, Schemes>, avx2::loops<Kernel, 2, Schemes>, avx2::loops<Kernel, 3, Schemes>};
  }
  return found;
}

}  // namespace sphverify
