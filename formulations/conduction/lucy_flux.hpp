// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Lucy's two-pass heat conduction with wall terms (Lucy 1977; Campbell 1989, Eqs. 51-53 with 65).
///
///   F_i     = -K_i [ sum_j (m_j/rho_j) T_j grad_i W_ij + T_B S_i ]                   [W/m^2]
///   de_i/dt = -(1/rho_i) [ sum_j (m_j/rho_j) F_j . grad_i W_ij + F_B . S_i ]         [W/kg]
///
/// Conserves nothing. With `walls: off` it is Lucy's original, Eq. 51.
struct LucyFlux {
  struct Flux {
    static constexpr PassInfo info{.name = "flux",
                                   .writes = Field::flux,
                                   .reads = {Field::density, Field::temperature, Field::conductivity},
                                   .kernel = {KernelWeight::gradient},
                                   .boundary = {BoundaryValue::temperature}};

    static auto pair(auto const&, auto const& j, auto const& W) {
      return ((j.m() / j.rho()) * j.T() * W.gradient()).eval();
    }
    static auto wall(auto const&, auto const& B) { return (B.T() * B.S()).eval(); }
    static auto finish(auto const& i, auto const& sum) { return (-i.K() * sum).eval(); }
  };

  static constexpr SchemeInfo info{
      .id = "conduction/lucy-flux",
      .title = "Lucy's two-pass form with wall terms",
      .source = "Lucy 1977; Campbell 1989, Eqs. 51-53 with 65",
      .equation = "F_i = -K_i [ sum_j (m_j/rho_j) T_j grad_i W_ij + T_B S_i ]\n"
                  "de_i/dt = -(1/rho_i) [ sum_j (m_j/rho_j) F_j.grad_i W_ij + F_B.S_i ]",
      .remarks = "Not conservative: half of a wall's heat enters through its wall term, half as an imbalance of the pairs near it.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::flux},
      .first_passes = {Flux::info}};
  using passes = PassList<Flux>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -(j.m() / j.rho()) * j.F().dot(W.gradient()) / i.rho();
  }
  static auto wall(auto const& i, auto const& B) { return -B.F().dot(B.S()) / i.rho(); }
};

}  // namespace sphverify
