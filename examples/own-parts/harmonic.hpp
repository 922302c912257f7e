// A form of heat conduction that sphverify does not have.
#pragma once

#include "formulations/scheme.hpp"

/// Difference form with the harmonic mean of conductivities, for media of very different ones (Cleary & Monaghan 1999, J. Comput.
/// Phys. 148, 227); the wall's term is that of conduction/brookshaw with this mean.
///
///   de_i/dt = sum_j m_j 4 K_i K_j/(K_i + K_j)/(rho_i rho_j) (T_i - T_j) W'(r_ij)/r_ij
///             + 4 K_i K_B/(K_i + K_B)/rho_i (T_B - T_i)/d_i A_i   [W/kg]
struct HarmonicConduction {
  static constexpr sphverify::SchemeInfo info{
      .id = "conduction/harmonic",
      .title = "Difference form with the harmonic mean of conductivities",
      .source = "Cleary & Monaghan 1999",
      .equation = "de_i/dt = sum_j m_j 4 K_i K_j/(K_i + K_j)/(rho_i rho_j) (T_i - T_j) W'(r_ij)/r_ij"
                  " + 4 K_i K_B/(K_i + K_B)/rho_i (T_B - T_i)/d_i A_i",
      .remarks = "An example of a scheme from outside.",
      .rate = sphverify::Rate::conduction_heating,
      .reads = {sphverify::Field::density, sphverify::Field::temperature, sphverify::Field::conductivity},
      .kernel = {sphverify::KernelWeight::radial},
      .boundary = {sphverify::BoundaryValue::temperature, sphverify::BoundaryValue::conductivity},
      .conserves = {sphverify::Invariant::energy},
      .claims = {.steady_on_any_particles = true, .mean = sphverify::ConductivityMean::harmonic}};

  static auto pair(auto const& i, auto const& j, auto const& W) {
    auto const K = 4.0 * i.K() * j.K() / (i.K() + j.K());
    return j.m() * K / (i.rho() * j.rho()) * (i.T() - j.T()) * W.radial();
  }
  static auto wall(auto const& i, auto const& B) {
    return 4.0 * i.K() * B.K() / (i.K() + B.K()) / i.rho() * (B.T() - i.T()) / B.d() * B.A();
  }
};
