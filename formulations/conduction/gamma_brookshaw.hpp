// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/conduction/brookshaw.hpp"

namespace sphverify {

/// Brookshaw's difference form with wall terms, over the part of the kernel that is filled with fluid: the renormalisation of
/// semi-analytical walls (Ferrand et al. 2013), with Gamma summed over particles (Macia et al. 2012).
///
///   Gamma_i = sum_j m_j/rho_j W_ij  with j = i
///   de_i/dt = 1/Gamma_i [ sum_j m_j (K_i + K_j)/(rho_i rho_j) (T_i - T_j) (r_ij . grad_i W_ij)/r_ij^2
///                         + (K_i + K_B)/rho_i (T_B - T_i)/d_i A_i ]                                    [W/kg]
///
/// Where the wall prescribes flux and no temperature its term is -2 F_B . S_i/(Gamma_i rho_i).
/// Pairs conserve sum_i Gamma_i m_i e_i, not energy; a uniform temperature is exactly steady.
struct GammaBrookshaw {
  struct Gamma {
    static constexpr PassInfo info{.name = "gamma",
                                   .writes = Field::pass_number,
                                   .reads = {Field::density},
                                   .kernel = {KernelWeight::value}};

    static auto pair(auto const&, auto const& j, auto const& W) { return j.m() / j.rho() * W.value(); }
    static double wall(auto const&, auto const&) { return 0.0; }
    static auto finish(auto const& i, auto const& sum) { return sum + i.m() / i.rho() * i.W0(); }
  };

  static constexpr SchemeInfo info{
      .id = "conduction/gamma-brookshaw",
      .title = "Brookshaw's difference form over Gamma",
      .source = "Brookshaw 1985; Campbell 1989, Eq. 63; Gamma as in Macia et al. 2012 and Ferrand et al. 2013",
      .equation = "Gamma_i = sum_j m_j/rho_j W_ij, j = i included\n"
                  "de_i/dt = 1/Gamma_i [ sum_j m_j (K_i+K_j)/(rho_i rho_j) (T_i-T_j) (r_ij.grad_i W_ij)/r_ij^2"
                  " + (K_i+K_B)/rho_i (T_B-T_i)/d_i A_i ]; where the wall prescribes flux only, its term is -2 F_B.S_i/(Gamma_i rho_i)",
      .remarks = "Makes up for the part of the kernel that a wall cuts off, and for sums that are not 1. Pairs conserve "
                 "sum Gamma_i m_i e_i only.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density, Field::temperature, Field::conductivity},
      .kernel = {KernelWeight::radial},
      .boundary = {BoundaryValue::temperature, BoundaryValue::conductivity},
      .boundary_if_prescribed = {BoundaryValue::flux},
      .first_passes = {Gamma::info},
      .difference_form = true,
      .claims = {.steady_on_any_particles = true, .linear_on_lattice = false, .mean = ConductivityMean::arithmetic},
      .supports_seen = 1,
      .wall_terms_are_exchange = false};
  using passes = PassList<Gamma>;

  static auto pair(auto const& i, auto const& j, auto const& W) { return Brookshaw::pair(i, j, W) / i.pass_number(); }
  static auto conductance(auto const& i, auto const& j, auto const& W) {
    return Brookshaw::conductance(i, j, W) / i.pass_number();
  }
  static auto wall(auto const& i, auto const& B) { return Brookshaw::wall(i, B) / i.pass_number(); }
};

}  // namespace sphverify
