// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/momentum/smoothed_pressure.hpp"

namespace sphverify {

/// Pressure-energy form at fixed smoothing length (Saitoh & Makino 2013, ApJ 768, 44; Hopkins 2013, MNRAS 428, 2840, whose
/// factors f_ij are 1 there).
///
///   a_i = -(Y_i/m_i) [ sum_j Y_j (1/Pbar_i + 1/Pbar_j) grad_i W_ij + (P_B/Pbar_i + 1) S_i ],   Y = m P/rho   [m/s^2]
///
/// Conserves linear momentum to round-off between particles. The wall term is ours: the surface integrals of the two
/// kernel estimates that the sum consists of, of Y/V = P over Pbar_i and of P/Pbar = 1.
struct PressureEnergy {
  static constexpr SchemeInfo info{
      .id = "momentum/pressure-energy",
      .title = "Pressure-energy form",
      .source = "Saitoh & Makino 2013; Hopkins 2013; wall term ours, as Campbell 1989, Eq. 11 has its own",
      .equation = "Pbar_i = (1/Gamma_i) sum_j Y_j W_ij, j = i included, Y = m P/rho\n"
                  "a_i = -(Y_i/m_i) [ sum_j Y_j (1/Pbar_i + 1/Pbar_j) grad_i W_ij + (P_B/Pbar_i + 1) S_i ]",
      .remarks = "No surface tension at contacts: pressure is smooth where density and temperature jump. At strong shocks one hot "
                 "particle is felt by all within its support; and a wall pushes gas in proportion to its pressure, cold gas not at "
                 "all but by viscosity. Factors f_ij for adaptive smoothing are left out.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .non_negative = {Field::pressure},
      .first_passes = {SmoothedPressure::info},
      .work_partner = "work/pressure-energy",
      .claims = {.energy_with_partner = true, .linear_on_lattice = false},
      .supports_seen = 2};
  using passes = PassList<SmoothedPressure>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-(i.P() / i.rho()) * j.m() * (j.P() / j.rho()) * (1.0 / i.pass_number() + 1.0 / j.pass_number()) * W.gradient()).eval();
  }
  static auto wall(auto const& i, auto const& B) {
    // Cold gas has P/Pbar = 0 whatever the wall prescribes.
    return (-(i.P() / i.pass_number() * B.P() + i.P()) / i.rho() * B.S()).eval();
  }
};

}  // namespace sphverify
