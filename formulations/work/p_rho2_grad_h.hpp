// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// Work of compression on internal energy, the partner of momentum/p-rho2-grad-h.
///
///   de_i/dt = P_i/(Omega_i rho_i^2) [ sum_j m_j (v_i - v_j) . grad_i W(r_ij, h_i) + rho_B (v_i - v_B) . S_i ]    [W/kg]
///
/// Between particles P_i/rho_i^2 times the rate of the summed density whose h follows it, so that without viscosity each particle
/// keeps its entropy, and with the partner energy is conserved to round-off: of m_i v_i.a_i, the share of P_i with every j is
/// what these terms give back. The wall's part is the share of P_i at the wall, as density/continuity has it; with the partner's
/// the wall's power is -sum_i m_i [ P_B v_i/rho_B^2 + P_i v_B/(Omega_i rho_i^2) ] rho_B . S_i, each half half of -P_B v_B . n per
/// area; a common velocity u more adds u times the wall's force.
struct InternalEnergyWorkGradH {
  static constexpr SchemeInfo info{
      .id = "work/p-rho2-grad-h",
      .title = "Work of compression on internal energy with grad-h terms",
      .source = "Springel & Hernquist 2002; Price 2012, J. Comput. Phys. 231, 759; wall term derived as Campbell 1989, Eq. 42",
      .equation =
          "de_i/dt = P_i/(Omega_i rho_i^2) [ sum_j m_j (v_i - v_j).grad_i W(r_ij,h_i) + rho_B (v_i - v_B).S_i ];"
          " Omega_i = 1 + h_i/(D rho_i) drho_i/dh_i",
      .remarks =
          "Conserves total energy together with momentum/p-rho2-grad-h, and away from walls each particle's entropy. Galilean "
          "invariant. For adaptive smoothing and a density that is summed.",
      .rate = Rate::internal_work,
      .reads = {Field::density, Field::pressure, Field::velocity, Field::omega},
      .kernel = {KernelWeight::own_gradients},
      .boundary = {BoundaryValue::velocity},
      .claims = {.steady_on_any_particles = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) { return share(i) * j.m() * (i.v() - j.v()).dot(W.gradient_i()); }
  static auto wall(auto const& i, auto const& B) { return share(i) * B.rho() * (i.v() - B.v()).dot(B.S()); }

 private:
  static auto share(auto const& one) { return one.P() / square(one.rho()) / one.Omega(); }
};

}  // namespace sphverify
