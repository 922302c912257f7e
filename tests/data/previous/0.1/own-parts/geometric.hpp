// SPDX-License-Identifier: 0BSD
// A form of heat conduction that sphverify does not have.
#pragma once

#include <cmath>

#include "formulations/scheme.hpp"

/// Difference form with the geometric mean of conductivities, between the arithmetic one of conduction/brookshaw and the harmonic
/// one of conduction/cleary-monaghan; wall terms as there.
///
///   de_i/dt = sum_j m_j 2 (K_i K_j)^(1/2)/(rho_i rho_j) (T_i - T_j) W'(r_ij)/r_ij
///             + 2 (K_i K_B)^(1/2)/rho_i (T_B - T_i)/d_i A_i   [W/kg]
struct GeometricConduction {
  static constexpr sphverify::SchemeInfo info{
      .id = "conduction/geometric",
      .title = "Difference form with the geometric mean of conductivities",
      .source = "after Brookshaw 1985",
      .equation = "de_i/dt = sum_j m_j 2 (K_i K_j)^(1/2)/(rho_i rho_j) (T_i - T_j) W'(r_ij)/r_ij"
                  " + 2 (K_i K_B)^(1/2)/rho_i (T_B - T_i)/d_i A_i",
      .remarks = "An example of a scheme from outside.",
      .rate = sphverify::Rate::conduction_heating,
      .reads = {sphverify::Field::density, sphverify::Field::temperature, sphverify::Field::conductivity},
      .kernel = {sphverify::KernelWeight::radial},
      .boundary = {sphverify::BoundaryValue::temperature, sphverify::BoundaryValue::conductivity},
      .conserves = {sphverify::Invariant::energy},
      .claims = {.steady_on_any_particles = true, .mean = sphverify::ConductivityMean::geometric}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    using std::sqrt;
    return j.m() * 2.0 * sqrt(i.K() * j.K()) / (i.rho() * j.rho()) * (i.T() - j.T()) * W.radial();
  }
  static auto wall(auto const& i, auto const& B) {
    using std::sqrt;
    return 2.0 * sqrt(i.K() * B.K()) / i.rho() * (B.T() - i.T()) / B.d() * B.A();
  }
};
