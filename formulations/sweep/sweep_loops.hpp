// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "formulations/density/continuity.hpp"
#include "formulations/momentum/gdsph.hpp"
#include "formulations/momentum/p_rho2.hpp"
#include "formulations/momentum/sqrt_p.hpp"
#include "formulations/sweep/row_loops.hpp"
#include "formulations/work/gdsph.hpp"
#include "formulations/work/internal_energy.hpp"
#include "formulations/work/sqrt_p.hpp"

// The loops over pairs that belong to no scheme. Included by the file that is compiled once per instruction set, and by
// nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

template <int Dim, class... Terms>
constexpr LoopOfSeveral of_several() {
  return {.terms = {sum_anywhere<Dim, Terms>...}, .made = loops_in_place<Dim, Terms...>()};
}

/// What a moving gas sweeps together: pressure and its usual work, with and without viscosity and continuity; and what
/// follows the places once more.
template <int Dim, class Momentum, class Work>
constexpr std::array<LoopOfSeveral, 5> of_gas() {
  using A = RateTerm<Momentum, Dim>;
  using E = RateTerm<Work, Dim>;
  using D = RateTerm<ContinuityDensity, Dim>;
  using V = ViscosityTerm<Dim, MonaghanViscosity>;
  return {of_several<Dim, A, E, D, V>(), of_several<Dim, A, E, V>(), of_several<Dim, A, E, D>(), of_several<Dim, A, E>(),
          of_several<Dim, E, D>()};
}

template <int Dim>
std::span<LoopOfSeveral const> all_of_several() {
  if constexpr (specialises) {
    static constexpr std::array of_forms{of_gas<Dim, PressureOverDensitySquared, InternalEnergyWork>(),
                                         of_gas<Dim, SquareRootOfPressure, SquareRootOfPressureWork>(),
                                         of_gas<Dim, GeometricDensity, GeometricDensityWork>()};
    static constexpr auto all = [] {
      std::array<LoopOfSeveral, of_forms.size() * of_forms[0].size()> joined{};
      std::size_t count = 0;
      for (auto const& form : of_forms)
        for (LoopOfSeveral const& one : form) joined[count++] = one;
      return joined;
    }();
    return all;
  } else {
    return {};
  }
}

#define SPHVERIFY_TEXT_OF(name) #name
#define SPHVERIFY_NAME_OF(name) SPHVERIFY_TEXT_OF(name)

/// Other files know of them by this name alone.
template <int Dim>
SweepLoops const& sweep_loops() {
  static SweepLoops const all = [] {
    SweepLoops loops{.instruction_set = SPHVERIFY_NAME_OF(SPHVERIFY_INSTRUCTION_SET),
                     .rows = rows<Dim>,
                     .of_several = all_of_several<Dim>(),
                     .density = loops_of_term<Dim, DensityTerm<Dim>>(),
                     .viscosity = loops_of_term<Dim, ViscosityTerm<Dim, MonaghanViscosity>>(),
                     .riemann_viscosity = loops_of_term<Dim, ViscosityTerm<Dim, RiemannViscosity>>(),
                     .approach = loops_of_term<Dim, ApproachTerm<Dim>>(),
                     .conductances = conductances<Dim>,
                     .conduct = conduct};
    loops.density.wants_value = true;
    return loops;
  }();
  return all;
}

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
