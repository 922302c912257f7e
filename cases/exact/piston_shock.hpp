// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// A piston drives a shock of constant strength into gas at rest, P = (gamma - 1) rho e.
///
/// The gas of density rho_0 and pressure P_0 fills x > 0. From t = 0 on the piston, at first at x = 0, moves
/// with the velocity u to +x and the gas next to it with it, at the pressure P_1. In the frame of the shock,
/// of speed D, mass, momentum and energy flow through unchanged (Rankine & Hugoniot; L. D. Landau &
/// E. M. Lifshitz, Fluid Mechanics, section 89):
///
///   rho_1 (D - u) = rho_0 D,   P_1 - P_0 = rho_0 D u,   e_1 - e_0 = (P_1 + P_0)/2 (1/rho_0 - 1/rho_1)
///
/// which for the flow of mass m = rho_0 D through the shock means
///
///   m^2 = rho_0 ((gamma+1) P_1 + (gamma-1) P_0)/2,   u = (P_1 - P_0)/m,
///   rho_1 = rho_0 ((gamma+1) P_1 + (gamma-1) P_0) / ((gamma-1) P_1 + (gamma+1) P_0).
///
/// P_0 = 0 gives the strong shock, D = (gamma+1)/2 u; P_1 = P_0 no shock: u = 0 and D is the speed of sound.
class PistonShock {
 public:
  PistonShock(double initial_pressure, double post_pressure, double density, double gamma);

  double piston_velocity() const;
  double shock_speed() const;
  double post_density() const;

  /// t >= 0. Behind the piston, where there is no gas, the state between piston and shock goes on.
  GasState at(double x, double t) const;

  /// Relative accuracy of the speeds, and of density, velocity and pressure away from the shock.
  double accuracy() const;

 private:
  GasState ahead_;
  GasState behind_;
  double shock_speed_;
};

}  // namespace sphverify::exact
