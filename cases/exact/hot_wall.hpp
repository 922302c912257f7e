// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Gas in x > x_w(t) = wall_velocity t that a hot (or cold) wall heats at uniform and constant pressure
/// P = (gamma-1) rho0 T0, with the conductivity K = K0 T/T0.
///
/// In the mass m per area from the wall, and because rho K = rho0 K0 is constant,
///
///   gamma dT/dt = d/dm (rho K dT/dm),   hence   T = T0 + (Tw - T0) erfc(eta),   eta = m/(2 sqrt(D tau)),
///   D = rho0 K0/gamma,   tau = start_time + t,   rho = rho0 T0/T,
///
/// and with b = (Tw/T0 - 1)/rho0 and ierfc the integral of erfc up to infinity
///
///   x     = x_w + m/rho0 + b 2 sqrt(D tau) (1/sqrt(pi) - ierfc(eta))
///   u     = wall_velocity + b sqrt(D/(pi tau)) (1 - exp(-eta^2))
///   Du/Dt = -b sqrt(D/pi) tau^(-3/2) (1/2 (1 - exp(-eta^2)) + eta^2 exp(-eta^2))
///   flux  = -K dT/dx = rho0 K0 (Tw - T0) exp(-eta^2)/sqrt(pi D tau)
///
/// As the pressure pushes nothing, the flow needs the body force Du/Dt per unit mass. Far from the wall the
/// gas moves as one, ever slower. In the mass coordinate this is the half space of H. S. Carslaw & J. C.
/// Jaeger, Conduction of Heat in Solids (1959), chapter II; that a product rho K which does not vary turns
/// the gas's equation into it is D. R. Chapman & M. W. Rubesin's observation (J. Aeronaut. Sci. 16 (1949)
/// 547).
///
/// Specific heat 1, so that T = e. Times t > -start_time. Points behind the wall have the state at the wall.
class HotWall {
 public:
  HotWall(double wall_temperature, double initial_temperature, double density, double conductivity,
          double gamma, double start_time, double wall_velocity);

  GasState at(double x, double t) const;
  double temperature(double x, double t) const;
  double flux(double x, double t) const;          ///< of heat along x, per area
  double acceleration(double x, double t) const;  ///< Du/Dt, the body force per unit mass
  double conductivity(double temperature) const;
  double pressure() const;
  double wall_position(double t) const;

  double mass_coordinate(double x, double t) const;    ///< mass per area between the wall and x
  double material_position(double m, double t) const;  ///< its inverse: where that particle is
  double material_velocity(double m, double t) const;

  /// Absolute accuracy of the temperature from t = 0 on within the distance 10 of the wall.
  double accuracy() const;

 private:
  double elapsed(double t) const;
  double heated_mass(double t) const;
  double expansion() const;
  double distance(double m, double t) const;
  double temperature_at(double eta) const;

  double wall_temperature_;
  double initial_temperature_;
  double density_;
  double conductivity_;
  double gamma_;
  double start_time_;
  double wall_velocity_;
};

}  // namespace sphverify::exact
