// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/scheme.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// Least squares over quadratic polynomials, with walls' foot points among the partners: generalised moving least squares (Trask,
/// Perego & Bochev 2017), the class of Schwaiger 2008 and Fatehi & Manzari 2011.
///
///   de_i/dt = 1/rho_i [ sum_j (K_i + K_j)/2 s_ij (T_j - T_i) + (K_i + K_B)/2 s_iB (T_B - T_i) ]      [W/kg]
///
/// s are the weights with which sum s (f - f_i) is the Laplacian of every quadratic f (formulations/least_squares), and with
/// (K_i + K_j)/2 div(K grad T): of K (T - T_i) + K_i (T - T_i) half the Laplacian. Where the wall prescribes flux and no
/// temperature its partner is the slope at the foot point, and its term -s_iB F_B.n/rho_i, which is off by the order of d^2 where K
/// varies (first order in the rate beside that wall, second in the temperature). `W.radial()` is s_ij [m^-2], B.A()
/// is s_iB d_i, or s_iB where flux is prescribed [m^-1].
///
/// The yardstick: conserves nothing, and has no maximum principle.
struct Gmls {
  static constexpr SchemeInfo info{
      .id = "conduction/gmls",
      .title = "Quadratic least squares with foot points of walls",
      .source = "Trask, Perego & Bochev 2017; K at pairs as in Brookshaw 1985 (Campbell 1989, Eq. 63)",
      .equation = "de_i/dt = 1/rho_i [ sum_j (K_i+K_j)/2 s_ij (T_j-T_i) + (K_i+K_B)/2 s_iB (T_B-T_i) ],"
                  " sum s (f-f_i) the Laplacian of every quadratic f\n"
                  "where the wall prescribes flux only, its partner is the slope there, and its term -s_iB F_B.n/rho_i",
      .remarks = "A yardstick for accuracy, shown among the controls: conserves nothing, and heat may flow from cold to hot. Needs as many partners as a quadratic "
                 "has coefficients.",
      .rate = Rate::conduction_heating,
      .reads = {Field::density, Field::temperature, Field::conductivity},
      .kernel = {KernelWeight::radial},
      .boundary = {BoundaryValue::temperature, BoundaryValue::conductivity},
      .boundary_if_prescribed = {BoundaryValue::flux},
      .difference_form = true,
      .claims = {.lattice_factors = 0, .steady_on_any_particles = true},
      .control = true,
      .wall_terms_are_exchange = false,
      .least_squares = true,
      .needs_partners = true};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    return conductance(i, j, W) * (i.T() - j.T());
  }
  static auto conductance(auto const& i, auto const& j, auto const& W) {
    return -0.5 * (i.K() + j.K()) / i.rho() * W.radial();
  }
  static auto wall(auto const& i, auto const& B) {
    if (B.prescribes_flux_only()) return -B.F().dot(B.S()) / i.rho();
    return 0.5 * (i.K() + B.K()) / i.rho() * (B.T() - i.T()) / B.d() * B.A();
  }
};

}  // namespace sphverify
