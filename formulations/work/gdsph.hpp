// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/gdsph (Wadsley, Keller & Quinn 2017, MNRAS 471, 2357).
///
///   de_i/dt = (P_i/rho_i) sum_j (m_j/rho_j) (v_i - v_j) . grad_i W_ij + 2 (P_B/rho_i) (v_i - v_B) . S_i   [W/kg]
///
/// A pair changes kinetic energy by -m_i m_j (P_i + P_j)/(rho_i rho_j) (v_i - v_j) . grad_i W_ij; each side takes the part of
/// its own pressure. The wall term is ours: with that of momentum/gdsph the wall's power is -2 (m_i/rho_i) P_B v_B . S_i. It is
/// also what a uniform compression asks for: the pairs see the part Gamma of it near a wall, and the integrals of 1 - Gamma and of d A
/// over the distance d are equal, so that twice S makes up for both.
struct GeometricDensityWork {
  static constexpr SchemeInfo info{
      .id = "work/gdsph",
      .title = "Work of compression on internal energy, partner of momentum/gdsph",
      .source = "Wadsley, Keller & Quinn 2017; wall term ours, by the budgets of Campbell 1989, Eqs. 17, 40",
      .equation = "de_i/dt = (P_i/rho_i) sum_j (m_j/rho_j) (v_i - v_j).grad_i W_ij + 2 (P_B/rho_i) (v_i - v_B).S_i",
      .remarks = "Conserves total energy together with momentum/gdsph. Galilean invariant.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .claims = {.steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * (i.P() / i.rho() / j.rho()) * (j.v() - i.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) { return -2.0 * (B.P() / i.rho()) * (B.v() - i.v()).dot(B.S()); }
};

}  // namespace sphverify
