// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Campbell's two-pass heat conduction, parallel to momentum/p-rho2 (Campbell 1989, Eqs. 47-49, 80-81, 85-86).
///
///   F_i     = -K_i rho_i [ sum_j m_j (T_j/rho_j^2 + T_i/rho_i^2) grad_i W_ij + (T_B/rho_B^2 + T_i/rho_i^2) rho_B S_i ]
///   de_i/dt = -sum_j m_j (F_j/rho_j^2 + F_i/rho_i^2) . grad_i W_ij - (F_B/rho_B^2 + F_i/rho_i^2) . S_i rho_B
///
/// Flux in W/m^2, heating in W/kg. Conserves energy to round-off between particles.
struct CampbellFlux {
  struct Flux {
    static constexpr PassInfo info{.name = "flux",
                                   .writes = Field::flux,
                                   .reads = {Field::density, Field::temperature, Field::conductivity},
                                   .kernel = {KernelWeight::gradient},
                                   .boundary = {BoundaryValue::temperature}};

    static auto pair(auto const& i, auto const& j, auto const& W) {
      return (j.m() * (j.T() / square(j.rho()) + i.T() / square(i.rho())) * W.gradient()).eval();
    }
    static auto wall(auto const& i, auto const& B) {
      return ((B.T() / square(B.rho()) + i.T() / square(i.rho())) * B.rho() * B.S()).eval();
    }
    static auto finish(auto const& i, auto const& sum) { return (-i.K() * i.rho() * sum).eval(); }
  };

  static constexpr SchemeInfo info{
      .id = "conduction/campbell-flux",
      .title = "Campbell's two-pass form, symmetrised as T/rho^2 and F/rho^2",
      .source = "Campbell 1989, Eqs. 47-49, 80-81, 85-86",
      .equation = "F_i = -K_i rho_i [ sum_j m_j (T_j/rho_j^2+T_i/rho_i^2) grad_i W_ij"
                  " + (T_B/rho_B^2+T_i/rho_i^2) rho_B S_i ]\n"
                  "de_i/dt = -sum_j m_j (F_j/rho_j^2+F_i/rho_i^2).grad_i W_ij - (F_B/rho_B^2+F_i/rho_i^2).S_i rho_B",
      .remarks = "On disordered particles it has growing modes, and a uniform temperature drives spurious fluxes. "
                 "In 1D the wall terms jump one support R from a wall, where rho_B tends to 0 as fast as S: for a particle "
                 "that is alone within reach the flux jumps by -K_i rho_i T_B n/(2 m), n the outward normal, and "
                 "where the wall prescribes a flux the heating by -F_B.n/(2 m).",
      .rate = Rate::conduction_heating,
      .reads = {Field::density},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::flux},
      .conserves = {Invariant::energy},
      .first_passes = {Flux::info}};
  using passes = PassList<Flux>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() * (j.F() / square(j.rho()) + i.F() / square(i.rho())).dot(W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    return -(B.F() / square(B.rho()) + i.F() / square(i.rho())).dot(B.S()) * B.rho();
  }
};

}  // namespace sphverify
