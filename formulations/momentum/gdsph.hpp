// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Pressure gradient over the geometric mean of densities (Wadsley, Keller & Quinn 2017, MNRAS 471, 2357, "GDSPH"; the form
/// that Monaghan 1992, section 3.1, has for sigma = 1).
///
///   a_i = -sum_j m_j (P_i + P_j)/(rho_i rho_j) grad_i W_ij - 2 P_B S_i/rho_i   [m/s^2]
///
/// Conserves linear momentum to round-off between particles. The wall term is ours: what crosses the face is P_B alone, and
/// sum_i m_i/rho_i 2 S_i is the wall's area times n where particles fill the space before it (the integral of A over the
/// distance is 1/2), so that the wall gives just the impulse that it prescribes.
struct GeometricDensity {
  static constexpr SchemeInfo info{
      .id = "momentum/gdsph",
      .title = "Pressure gradient over the product of densities",
      .source = "Wadsley, Keller & Quinn 2017; wall term ours, by the budgets of Campbell 1989, Eqs. 17, 40",
      .equation = "a_i = -sum_j m_j (P_i + P_j)/(rho_i rho_j) grad_i W_ij - 2 P_B S_i/rho_i",
      .remarks = "No spurious tension at contacts between gases of different density as strong as that of P/rho^2. A wall "
                 "gives 2 P_B S_i/rho_i, of which nothing is the gas's own. A uniform gas at rest is not at rest near a wall, as "
                 "with P/rho^2.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .work_partner = "work/gdsph",
      .claims = {.energy_with_partner = true},
      .wall_pressure_share = 1.0};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (i.P() + j.P()) / i.rho() / j.rho() * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) { return (-2.0 * B.P() / i.rho() * B.S()).eval(); }
};

}  // namespace sphverify
