// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"
#include "formulations/conduction/correction_matrix.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// Divergence of a flux, both with gradients that are exact where a field is linear, on any particles and up to walls (Randles &
/// Libersky 1996; Bonet & Lok 1999); a wall counts as one more neighbour, at its foot point.
///
///   L_i^-1  = sum_j m_j/rho_j (r_j - r_i) (x) grad_i W_ij + (r_B - r_i) (x) S_i
///   F_i     = -K_i L_i [ sum_j m_j/rho_j (T_j - T_i) grad_i W_ij + (T_B - T_i) S_i ]                [W/m^2]
///   de_i/dt = -1/rho_i [ sum_j m_j/rho_j (F_j - F_i) . L_i grad_i W_ij + (F_B - F_i) . L_i S_i ]    [W/kg]
///
/// Conserves nothing; a temperature that goes up and down from one particle to the next has no flux.
struct CorrectedFlux {
  struct Matrix {
    static constexpr PassInfo info{.name = "correction-matrix",
                                   .writes = Field::pass_tensor,
                                   .reads = {Field::density},
                                   .kernel = {KernelWeight::gradient}};

    static auto pair(auto const&, auto const& j, auto const& W) {
      return -j.m() / j.rho() * outer(W.separation(), W.gradient());  // W.separation() is r_i - r_j
    }
    static auto wall(auto const&, auto const& B) { return (B.d() * outer(B.n(), B.S())).eval(); }
    static auto finish(auto const&, auto const& sum) { return correction_matrix(sum); }
  };
  struct Flux {
    static constexpr PassInfo info{.name = "flux",
                                   .writes = Field::flux,
                                   .reads = {Field::density, Field::temperature, Field::conductivity},
                                   .kernel = {KernelWeight::gradient},
                                   .boundary = {BoundaryValue::temperature}};

    static auto pair(auto const& i, auto const& j, auto const& W) {
      return (j.m() / j.rho() * (j.T() - i.T()) * W.gradient()).eval();
    }
    static auto wall(auto const& i, auto const& B) { return ((B.T() - i.T()) * B.S()).eval(); }
    static auto finish(auto const& i, auto const& sum) { return (-i.K() * (i.pass_tensor() * sum)).eval(); }
  };

  static constexpr SchemeInfo info{
      .id = "conduction/corrected-flux",
      .title = "Two-pass form with corrected gradients",
      .source = "Randles & Libersky 1996; Bonet & Lok 1999; two passes as in Campbell 1989, Eqs. 51-53",
      .equation = "L_i^-1 = sum_j m_j/rho_j (r_j-r_i) (x) grad_i W_ij + (r_B-r_i) (x) S_i\n"
                  "F_i = -K_i L_i [ sum_j m_j/rho_j (T_j-T_i) grad_i W_ij + (T_B-T_i) S_i ]\n"
                  "de_i/dt = -1/rho_i [ sum_j m_j/rho_j (F_j-F_i).L_i grad_i W_ij + (F_B-F_i).L_i S_i ]",
      .remarks = "Exact where temperature is linear, at walls of given temperature with a closure that is exact there (quotient, one-sided). "
                 "Conserves nothing, does not feel what changes from one particle to the next, and grows on disorder. With the closure "
                 "interpolated heat never enters a medium with K = 0 where it is cold.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density},
      .kernel = {KernelWeight::gradient},
      .boundary = {BoundaryValue::flux},
      .first_passes = {Matrix::info, Flux::info},
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true},
      .supports_seen = 2,
      .wall_terms_are_exchange = false,
      .needs_partners = true};
  using passes = PassList<Matrix, Flux>;

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return -j.m() / (i.rho() * j.rho()) * (j.F() - i.F()).dot(i.pass_tensor() * W.gradient());
  }
  static auto wall(auto const& i, auto const& B) {
    return -(B.F() - i.F()).dot(i.pass_tensor() * B.S()) / i.rho();
  }
};

}  // namespace sphverify
