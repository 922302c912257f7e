// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/square.hpp"
#include "formulations/basics/vector.hpp"
#include "formulations/scheme.hpp"

namespace sphverify {

/// The variational form where smoothing lengths follow the density (Springel & Hernquist 2002; Price 2012, J. Comput. Phys. 231,
/// 759): P/rho^2 with the kernel by either particle's own h, over Omega, which holds what a change of h adds
/// (density/grad_h.hpp).
///
///   a_i = -sum_j m_j [ P_i/(Omega_i rho_i^2) grad_i W(r_ij, h_i) + P_j/(Omega_j rho_j^2) grad_i W(r_ij, h_j) ]
///         - [ P_B/rho_B^2 + P_i/(Omega_i rho_i^2) ] rho_B S_i                                                [m/s^2]
///
/// Between particles m_i a_i = -dE/dr_i with E = sum_j m_j e_j(rho_j) at fixed entropies: de_j = P_j/rho_j^2 drho_j, and a
/// density that is summed with h_j answers by drho_j/dr_i = m_i grad_i W(r_ij, h_j)/Omega_j. Conserves linear momentum to
/// round-off.
///
/// Walls as momentum/p-rho2 has them, with what P_i/rho_i^2 becomes; S_i is of h_i, and a wall has no h, so that its own half has
/// Omega = 1. Of the normalised density, over Gamma, the gradient of E would have P_k/(Omega_k Gamma_k rho_k^2) in pairs and
/// walls, and no P_B: its pairs drive a uniform gas towards a wall, by -(P/rho) grad int W/Gamma, an integral over the gas that
/// is 1 far from a wall and ln 2 on it. So Gamma is left to Omega, and within a support of a wall forces are no gradient.
struct PressureOverDensitySquaredGradH {
  static constexpr SchemeInfo info{
      .id = "momentum/p-rho2-grad-h",
      .title = "P/rho^2 with grad-h terms, of smoothing lengths that follow the density",
      .source = "Springel & Hernquist 2002; Price 2012, J. Comput. Phys. 231, 759; wall term after Campbell 1989, Eqs. 68, 82",
      .equation =
          "a_i = -sum_j m_j [ P_i/(Omega_i rho_i^2) grad_i W(r_ij,h_i) + P_j/(Omega_j rho_j^2) grad_i W(r_ij,h_j) ]"
          " - (P_B/rho_B^2 + P_i/(Omega_i rho_i^2)) rho_B S_i; Omega_i = 1 + h_i/(D rho_i) drho_i/dh_i",
      .remarks =
          "The gradient of the internal energy at fixed entropies, but for walls. For adaptive smoothing and a density that is "
          "summed: with one h for all it is momentum/p-rho2. Near walls forces are no gradient, a uniform gas is not at rest "
          "there, and in 1D the wall term jumps one support R from a wall by as much as that form's.",
      .rate = Rate::acceleration,
      .reads = {Field::density, Field::pressure, Field::omega},
      .kernel = {KernelWeight::own_gradients},
      .boundary = {BoundaryValue::pressure},
      .conserves = {Invariant::momentum},
      .work_partner = "work/p-rho2-grad-h",
      .claims = {.energy_with_partner = true}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return (-j.m() * (share(i) * W.gradient_i() + share(j) * W.gradient_j())).eval();
  }
  static auto wall(auto const& i, auto const& B) { return (-(B.P() / square(B.rho()) + share(i)) * B.rho() * B.S()).eval(); }

 private:
  static auto share(auto const& one) { return one.P() / square(one.rho()) / one.Omega(); }
};

}  // namespace sphverify
