// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/simd/instruction_set.hpp"
#include "formulations/sweep/sweep.hpp"

// The loops over pairs by name. Their code is compiled once per instruction set (scheme_loops.hpp, sweep_loops.hpp,
// kernel_columns.hpp); which set runs is chosen here.
namespace sphverify {

#define SPHVERIFY_DECLARE_LOOPS                 \
  template <class Scheme, int Dim>              \
  SchemeLoops const& scheme_loops();            \
  template <int Dim>                            \
  SweepLoops const& sweep_loops();              \
  template <class Kernel, int Dim>              \
  KernelColumns kernel_columns();
namespace baseline {
SPHVERIFY_DECLARE_LOOPS
}  // namespace baseline
namespace avx2 {
SPHVERIFY_DECLARE_LOOPS
}  // namespace avx2
#undef SPHVERIFY_DECLARE_LOOPS

/// Those of a scheme for this processor.
template <class Scheme, int Dim>
SchemeLoops const& loops_of_scheme() {
  if constexpr (architecture_may_have_avx2) {
    if (processor_has_avx2()) return avx2::scheme_loops<Scheme, Dim>();
  }
  return baseline::scheme_loops<Scheme, Dim>();
}

/// Those that belong to no scheme, for this processor.
template <int Dim>
SweepLoops const& loops_of_sweep() {
  if constexpr (architecture_may_have_avx2) {
    if (processor_has_avx2()) return avx2::sweep_loops<Dim>();
  }
  return baseline::sweep_loops<Dim>();
}

/// A kernel's in a dimension, for this processor.
template <class Kernel, int Dim>
KernelColumns columns_of_kernel() {
  if constexpr (architecture_may_have_avx2) {
    if (processor_has_avx2()) return avx2::kernel_columns<Kernel, Dim>();
  }
  return baseline::kernel_columns<Kernel, Dim>();
}

}  // namespace sphverify
