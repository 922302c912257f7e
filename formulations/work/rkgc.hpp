// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/momentum/reverse_correction.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/rkgc. Ours.
///
///   de_i/dt = (P_i/rho_i) sum_j m_j/rho_j (v_i - v_j) . L_j grad_i W_ij + (P_B/rho_i) (sigma_i . n) (v_i - v_B) . n   [W/kg]
///
/// A pair changes kinetic energy by -V_i V_j (v_i - v_j) . (P_i L_j + P_j L_i) grad_i W_ij, V = m/rho; each side takes the part of its
/// own pressure. With momentum/rkgc the wall's power is -V_i P_B (sigma_i . n) v_B . n.
struct ReverseCorrectedWork {
  static constexpr SchemeInfo info{
      .id = "work/rkgc",
      .title = "Work of compression on internal energy, partner of momentum/rkgc",
      .source = "ours: the energy-conserving partner of momentum/rkgc; wall term by the budget of Campbell 1989, Eq. 40",
      .equation = "L_i^-1 = (1/Gamma_i) [ sum_j m_j/rho_j (r_j-r_i) (x) grad_i W_ij + d_i n (x) S_i ]\n"
                  "sigma_i = -sum_j m_j/rho_j (L_i + L_j) grad_i W_ij\n"
                  "de_i/dt = (P_i/rho_i) sum_j m_j/rho_j (v_i-v_j).L_j grad_i W_ij + (P_B/rho_i) (sigma_i.n) (v_i-v_B).n",
      .remarks = "Conserves total energy together with momentum/rkgc. Galilean invariant.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .first_passes = {ReverseCorrection::info, MissingSurface::info},
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true},
      .supports_seen = 2,
      .needs_partners = true};
  using passes = PassList<ReverseCorrection, MissingSurface>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * (i.P() / i.rho() / j.rho()) * (j.v() - i.v()).dot(j.pass_tensor() * W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    return -(B.P() / i.rho()) * i.pass_vector().dot(B.n()) * (B.v() - i.v()).dot(B.n());
  }
};

}  // namespace sphverify
