// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Brookshaw's difference form of heat conduction with wall terms (Brookshaw 1985; Campbell 1989, Eq. 63).
///
///   de_i/dt = sum_j m_j (K_i + K_j)/(rho_i rho_j) (T_i - T_j) (r_ij . grad_i W_ij)/r_ij^2
///             + (K_i + K_B)/rho_i (T_B - T_i)/d_i A_i                                          [W/kg]
///
/// Where the wall prescribes flux and no temperature its term is -2 F_B . S_i/rho_i instead, which is ours: the
/// factor 2 compensates for the half of the kernel beyond the wall, as in the term that it replaces.
/// Conserves energy to round-off between particles; a uniform temperature is exactly steady.
struct Brookshaw {
  static constexpr SchemeInfo info{
      .id = "conduction/brookshaw",
      .title = "Brookshaw's difference form with wall terms",
      .source = "Brookshaw 1985; Campbell 1989, Eq. 63",
      .equation = "de_i/dt = sum_j m_j (K_i+K_j)/(rho_i rho_j) (T_i-T_j) (r_ij.grad_i W_ij)/r_ij^2"
                  " + (K_i+K_B)/rho_i (T_B-T_i)/d_i A_i\n"
                  "where the wall prescribes flux only, its term is -2 F_B.S_i/rho_i (ours)",
      .remarks = "Real, negative spectrum on any particles. At fixed h/dx the error tends to a floor, unless h = dx on a lattice.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density, Field::temperature, Field::conductivity},
      .kernel = {KernelWeight::radial},
      .boundary = {BoundaryValue::temperature, BoundaryValue::conductivity},
      .boundary_if_prescribed = {BoundaryValue::flux},
      .conserves = {Invariant::energy},
      .difference_form = true,
      .claims = {.steady_on_any_particles = true, .mean = ConductivityMean::arithmetic}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return conductance(i, j, W) * (i.T() - j.T());
  }
  static auto conductance(auto const& i, auto const& j, auto const& W) {
    return j.m() * (i.K() + j.K()) / (i.rho() * j.rho()) * W.radial();
  }
  static auto wall(auto const& i, auto const& B) {
    if (B.prescribes_flux_only()) return -2.0 * B.F().dot(B.S()) / i.rho();
    return (i.K() + B.K()) / i.rho() * (B.T() - i.T()) / B.d() * B.A();
  }
};

}  // namespace sphverify
