// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/momentum/smoothed_pressure.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/pressure-energy (Hopkins 2013, MNRAS 428, 2840).
///
///   de_i/dt = (Y_i/m_i) (1/Pbar_i) [ sum_j Y_j (v_i - v_j) . grad_i W_ij + P_B (v_i - v_B) . S_i ],   Y = m P/rho   [W/kg]
///
/// A pair changes kinetic energy by -Y_i Y_j (1/Pbar_i + 1/Pbar_j) (v_i - v_j) . grad_i W_ij; each side takes the part of its own
/// Pbar. The wall term is ours, the surface integral of the same kernel estimate.
struct PressureEnergyWork {
  static constexpr SchemeInfo info{
      .id = "work/pressure-energy",
      .title = "Work of compression on internal energy, partner of momentum/pressure-energy",
      .source = "Hopkins 2013; wall term ours, as Campbell 1989, Eq. 42 has its own",
      .equation = "Pbar_i = (1/Gamma_i) sum_j Y_j W_ij, j = i included, Y = m P/rho\n"
                  "de_i/dt = (Y_i/m_i) (1/Pbar_i) [ sum_j Y_j (v_i - v_j).grad_i W_ij + P_B (v_i - v_B).S_i ]",
      .remarks = "Conserves total energy together with momentum/pressure-energy. Galilean invariant.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure, BoundaryValue::velocity},
      .non_negative = {Field::pressure},
      .first_passes = {SmoothedPressure::info},
      .claims = {.steady_on_any_particles = true, .linear_on_lattice = false},
      .supports_seen = 1};
  using passes = PassList<SmoothedPressure>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -(i.P() / i.rho() / i.pass_number()) * j.m() * (j.P() / j.rho()) * (j.v() - i.v()).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    return -(i.P() / i.pass_number() * B.P() / i.rho()) * (B.v() - i.v()).dot(B.S());
  }
};

}  // namespace sphverify
