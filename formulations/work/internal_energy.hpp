// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/p-rho2 (Campbell 1989, Eq. 42).
///
///   de_i/dt = -sum_j m_j (P_j/rho_j^2) (v_j - v_i) . grad_i W_ij - (P_B/rho_B) (v_B - v_i) . S_i   [W/kg]
///
/// With momentum/p-rho2 it conserves internal plus kinetic energy to round-off between particles.
struct InternalEnergyWork {
  static constexpr SchemeInfo info{
      .id = "work/internal-energy",
      .title = "Work of compression on internal energy, partner of momentum/p-rho2",
      .source = "Campbell 1989, Eq. 42",
      .equation = "de_i/dt = -sum_j m_j (P_j/rho_j^2) (v_j - v_i).grad_i W_ij - (P_B/rho_B) (v_B - v_i).S_i",
      .remarks = "Conserves total energy together with momentum/p-rho2. Galilean invariant. "
                 "In 1D the wall term jumps one support R from a wall as that of momentum/p-rho2 does: a particle that is "
                 "alone within reach gets P_B (v_i - v_B).n/(2 m) up to R, n the outward normal, and 0 beyond.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .claims = {.steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * (j.P() / square(j.rho())) * (j.v() - i.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) { return -(B.P() / B.rho()) * (B.v() - i.v()).dot(B.S()); }
};

}  // namespace sphverify
