// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Work of pressure forces on internal plus kinetic energy (Campbell 1989, Eqs. 37, 78, 84).
///
///   d(e + v^2/2)_i/dt = -sum_j m_j (P_j v_j/rho_j^2 + P_i v_i/rho_i^2) . grad_i W_ij
///                       - (P_B v_B/rho_B^2 + P_i v_i/rho_i^2) . S_i rho_B                     [W/kg]
///
/// Conserves total energy to round-off between particles. Not Galilean invariant by itself: a boost u adds u . a_i.
struct TotalEnergyWork {
  static constexpr SchemeInfo info{
      .id = "work/total-energy",
      .title = "Work on internal plus kinetic energy, symmetrised as P v/rho^2",
      .source = "Campbell 1989, Eqs. 37, 78, 84",
      .equation = "d(e + v^2/2)_i/dt = -sum_j m_j (P_j v_j/rho_j^2 + P_i v_i/rho_i^2).grad_i W_ij"
                  " - (P_B v_B/rho_B^2 + P_i v_i/rho_i^2).S_i rho_B",
      .remarks = "Partner of momentum/p-rho2. Gives the rate of total energy, not of internal energy. "
                 "In 1D the wall term jumps one support R from a wall as that of momentum/p-rho2 does: a particle that is "
                 "alone within reach gets -P_B v_B.n/(2 m) up to R, n the outward normal, and 0 beyond.",
      .rate = Rate::total_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .conserves = {Invariant::energy},
      .claims = {.galilean_invariant = false}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * (j.P() / square(j.rho()) * j.v() + i.P() / square(i.rho()) * i.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    return -(B.P() / square(B.rho()) * B.v() + i.P() / square(i.rho()) * i.v()).dot(B.S()) * B.rho();
  }
};

}  // namespace sphverify
