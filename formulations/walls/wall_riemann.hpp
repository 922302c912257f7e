// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace sphverify {

// Half of a Riemann problem: a gamma-law gas at rest or in motion against a wall (Toro, Riemann Solvers and
// Numerical Methods for Fluid Dynamics, 3rd ed., section 6.3.3). One wave runs from the wall into the gas, a
// shock where the two close in on each other and a rarefaction where they part; closed forms for either
// question.

/// Pressure at a wall that a gas of density rho and pressure P meets with a closing speed (v - v_B).n,
/// negative where they part; 0 where the gas cannot follow.  [Pa]
/// P >= 0.
inline double pressure_at_wall(double rho, double P, double closing_speed, double gamma) {
  if (closing_speed > 0.0) {
    double const A = 2.0 / ((gamma + 1.0) * rho);
    double const B = (gamma - 1.0) / (gamma + 1.0) * P;
    return P + 0.5 * closing_speed / A *
                   (closing_speed + std::sqrt(closing_speed * closing_speed + 4.0 * A * (P + B)));
  }
  if (P <= 0.0) return P;
  double const c = std::sqrt(gamma * P / rho);
  double const base = 1.0 + 0.5 * (gamma - 1.0) * closing_speed / c;
  return base > 0.0 ? P * std::pow(base, 2.0 * gamma / (gamma - 1.0)) : 0.0;
}

/// Closing speed (v - v_B).n at which the same gas meets a wall of pressure P_B.  [m/s]
inline double closing_speed_at_wall(double rho, double P, double wall_pressure, double gamma) {
  if (wall_pressure > P) {
    double const A = 2.0 / ((gamma + 1.0) * rho);
    double const B = (gamma - 1.0) / (gamma + 1.0) * P;
    return (wall_pressure - P) * std::sqrt(A / (wall_pressure + B));
  }
  if (P <= 0.0) return 0.0;
  double const c = std::sqrt(gamma * P / rho);
  if (wall_pressure <= 0.0) return -2.0 * c / (gamma - 1.0);
  return 2.0 * c / (gamma - 1.0) * std::expm1(0.5 * (gamma - 1.0) / gamma * std::log(wall_pressure / P));
}

}  // namespace sphverify
