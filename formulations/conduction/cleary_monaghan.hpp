// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/conduction/conductivity_mean.hpp"
#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Difference form with the harmonic mean of conductivities, so that flux is continuous where they jump (Cleary & Monaghan
/// 1999). The wall terms are those of conduction/brookshaw with this mean, which is ours.
///
///   de_i/dt = sum_j m_j/(rho_i rho_j) 4 K_i K_j/(K_i + K_j) (T_i - T_j) (r_ij . grad_i W_ij)/r_ij^2
///             + 4 K_i K_B/((K_i + K_B) rho_i) (T_B - T_i)/d_i A_i                                      [W/kg]
///
/// Where the wall prescribes flux and no temperature its term is -2 F_B . S_i/rho_i.
/// Conserves energy to round-off between particles; a uniform temperature is exactly steady.
struct ClearyMonaghan {
  static constexpr SchemeInfo info{
      .id = "conduction/cleary-monaghan",
      .title = "Difference form with the harmonic mean of conductivities",
      .source = "Cleary & Monaghan 1999, J. Comput. Phys. 148, 227; wall terms after Campbell 1989, Eq. 63",
      .equation = "de_i/dt = sum_j m_j/(rho_i rho_j) 4 K_i K_j/(K_i+K_j) (T_i-T_j) (r_ij.grad_i W_ij)/r_ij^2"
                  " + 4 K_i K_B/((K_i+K_B) rho_i) (T_B-T_i)/d_i A_i\n"
                  "where the wall prescribes flux only, its term is -2 F_B.S_i/rho_i (ours)",
      .remarks = "For conductivities that jump, with faces of cells: beside the kernel's weights the mean cannot be seen. Real, negative "
                 "spectrum on any particles; conduction/brookshaw where K is uniform. A pair of which one does not conduct exchanges nothing: heat never enters a medium "
                 "with K = 0 where it is cold.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density, Field::temperature, Field::conductivity},
      .kernel = {KernelWeight::radial},
      .boundary = {BoundaryValue::temperature, BoundaryValue::conductivity},
      .boundary_if_prescribed = {BoundaryValue::flux},
      .conserves = {Invariant::energy},
      .difference_form = true,
      .claims = {.steady_on_any_particles = true, .mean = ConductivityMean::harmonic}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return conductance(i, j, W) * (i.T() - j.T());
  }
  static auto conductance(auto const& i, auto const& j, auto const& W) {
    return j.m() * 2.0 * harmonic_mean(i.K(), j.K()) / (i.rho() * j.rho()) * W.radial();
  }
  static auto wall(auto const& i, auto const& B) {
    if (B.prescribes_flux_only()) return -2.0 * B.F().dot(B.S()) / i.rho();
    return 2.0 * harmonic_mean(i.K(), B.K()) / i.rho() * (B.T() - i.T()) / B.d() * B.A();
  }
};

}  // namespace sphverify
