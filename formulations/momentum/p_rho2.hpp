// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Pressure gradient symmetrised as P/rho^2 (Campbell 1989, Eqs. 11, 68, 82).
///
///   a_i = -sum_j m_j (P_j/rho_j^2 + P_i/rho_i^2) grad_i W_ij - (P_B/rho_B^2 + P_i/rho_i^2) rho_B S_i   [m/s^2]
///
/// Conserves linear momentum to round-off between particles; walls exchange it.
struct PressureOverDensitySquared {
  static constexpr SchemeInfo info{
      .id = "momentum/p-rho2",
      .title = "Pressure gradient symmetrised as P/rho^2",
      .source = "Campbell 1989, Eqs. 11, 68, 82",
      .equation = "a_i = -sum_j m_j (P_j/rho_j^2 + P_i/rho_i^2) grad_i W_ij - (P_B/rho_B^2 + P_i/rho_i^2) rho_B S_i",
      .remarks = "A uniform gas at rest is not at rest near a wall: the residual shrinks only as h/dx grows. "
                 "In 1D the wall term jumps one support R from a wall: rho_B = 2 m W(R) tends to 0 there as fast as S, so "
                 "that a particle that is alone within reach feels a = P_B/(2 m) up to R and 0 beyond (Eqs. "
                 "11-13). In 2D and 3D S/rho_B tends to 0 and nothing jumps.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .work_partner = "work/internal-energy",
      .claims = {.energy_with_partner = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (j.P() / square(j.rho()) + i.P() / square(i.rho())) * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    return (-(B.P() / square(B.rho()) + i.P() / square(i.rho())) * B.rho() * B.S()).eval();
  }
};

}  // namespace sphverify
