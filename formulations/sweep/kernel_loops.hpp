#pragma once

#include <span>

#include "formulations/density/continuity.hpp"
#include "formulations/momentum/gdsph.hpp"
#include "formulations/momentum/p_rho2.hpp"
#include "formulations/momentum/sqrt_p.hpp"
#include "formulations/sweep/fused.hpp"
#include "formulations/work/gdsph.hpp"
#include "formulations/work/internal_energy.hpp"
#include "formulations/work/sqrt_p.hpp"

// The loops over pairs that a kernel has. Included by the files that are compiled once per instruction set, and by nothing
// else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// What a moving gas sweeps together: pressure and its usual work, with and without viscosity and continuity; and what
/// follows the places once more.
template <int Dim, class Kernel, class Momentum, class Work>
constexpr std::array<FusedSweep, 6> fused_gas() {
  using A = RateTerm<Momentum, Dim>;
  using E = RateTerm<Work, Dim>;
  using D = RateTerm<ContinuityDensity, Dim>;
  using V = ViscosityTerm<Dim, Kernel, MonaghanViscosity>;
  return {fused<Dim, Kernel, A, E>(), fused<Dim, Kernel, A, E, D>(), fused<Dim, Kernel, A, E, V>(),
          fused<Dim, Kernel, A, E, D, V>(), fused<Dim, Kernel, E>(),    fused<Dim, Kernel, E, D>()};
}

/// Of a form of heat conduction, which is swept by itself. Forms of gas move together, and alone are asked for their rates once.
template <int Dim, class Kernel, class Scheme>
constexpr auto fused_alone() {
  if constexpr (Scheme::info.rate == Rate::conduction_heating) {
    return fused_passes<Dim, Kernel, Scheme>();
  } else {
    return std::array<FusedSweep, 0>{};
  }
}

template <int Dim, class Kernel, class... Schemes>
constexpr auto all_fused_of_kernel() {
  return joined(fused_alone<Dim, Kernel, Schemes>()...,
                std::array{fused<Dim, Kernel, DensityTerm<Dim, Kernel>>(), fused<Dim, Kernel, ApproachTerm<Dim, Kernel>>()},
                fused_gas<Dim, Kernel, PressureOverDensitySquared, InternalEnergyWork>(),
                fused_gas<Dim, Kernel, SquareRootOfPressure, SquareRootOfPressureWork>(),
                fused_gas<Dim, Kernel, GeometricDensity, GeometricDensityWork>());
}

/// Stored slopes are of particles that mostly stand still: their forms are fused one by one.
template <int Dim, class Kernel, class... Schemes>
constexpr auto all_fused(std::tuple<Schemes...> const*) {
  if constexpr (is_stored<Kernel>) {
    return joined(fused_alone<Dim, Kernel, Schemes>()...);
  } else {
    return all_fused_of_kernel<Dim, Kernel, Schemes...>();
  }
}

template <int Dim, class Kernel, class Schemes>
std::span<FusedSweep const> special_loops() {
  if constexpr (specialises) {
    static constexpr auto all = all_fused<Dim, Kernel>(static_cast<Schemes const*>(nullptr));
    return all;
  } else {
    return {};
  }
}

/// A term that is the kernel's own. Beside stored slopes those of the particles' kernel serve: they end at its support.
template <class Term, class Kernel, int Dim>
constexpr RowFunction own_row() {
  if constexpr (is_stored<Kernel>) {
    return nullptr;
  } else {
    return sum_row<Term, Dim>;
  }
}

#define SPHVERIFY_TEXT_OF(name) #name
#define SPHVERIFY_NAME_OF(name) SPHVERIFY_TEXT_OF(name)

/// All loops of a kernel; other files know of them by this name alone.
/// @tparam Schemes tuple of those that get a loop of their own with this kernel
template <template <int> class Kernel, int Dim, class Schemes>
SweepKernels const& loops() {
  using K = Kernel<Dim>;
  static SweepKernels const all{.instruction_set = SPHVERIFY_NAME_OF(SPHVERIFY_INSTRUCTION_SET),
                                .rows = rows<Dim, K>,
                                .fused = special_loops<Dim, K, Schemes>(),
                                .density = own_row<DensityTerm<Dim, K>, K, Dim>(),
                                .viscosity = own_row<ViscosityTerm<Dim, K, MonaghanViscosity>, K, Dim>(),
                                .riemann_viscosity = own_row<ViscosityTerm<Dim, K, RiemannViscosity>, K, Dim>(),
                                .approach = own_row<ApproachTerm<Dim, K>, K, Dim>(),
                                .conductances = conductances<Dim, K>,
                                .conduct = conduct};
  return all;
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
