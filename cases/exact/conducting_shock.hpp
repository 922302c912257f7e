// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Shock of steady shape in a gas that conducts heat but is not viscous, running to the right into gas at
/// rest, with constant conductivity K.
///
/// Relative to the shock gas streams to the left at the speed w: w0 ahead, w1 behind, with j = rho w. What
/// enters a layer leaves it:
///
///   P + j w = P0 + j w0
///   j (gamma/(gamma-1) P/rho + w^2/2) + K dT/dxi = j (gamma/(gamma-1) P0/rho0 + w0^2/2),   xi = x - x_s(t)
///
/// By the first P/rho = w (A - w), A = w0 + P0/j, and T = e = P/((gamma-1) rho). This turns the second into
///
///   (2 w - A) dw/dxi = j (gamma+1)/(2 K) (w0 - w) (w - w1).
///
/// With q = (w - w1)/(w0 - w1), which grows from 0 behind to 1 ahead, and q = 1/2 in the centre x_s,
///
///   xi = -a ln(2 (1-q)) + b ln(2 q),
///   a = l ((gamma+1) P1 - (3-gamma) P0)/(2 (P1 - P0)),   b = a - 2 l,   l = 2 K/(j (gamma+1)).
///
/// The profile dies away as exp(-xi/a) ahead and exp(xi/b) behind. It is continuous only if 2 w1 > A, which
/// is b > 0 or P1 (3-gamma) < P0 (gamma+1); a stronger shock would jump at one temperature. Rayleigh, Proc.
/// R. Soc. A 84 (1910) 247; L. D. Landau & E. M. Lifshitz, Fluid Mechanics (1987), section 95; Ya. B.
/// Zel'dovich & Yu. P. Raizer, Physics of Shock Waves (1967), chapter VII.
class ConductingShock {
 public:
  /// The centre is where x_s is at t = 0.
  ConductingShock(double initial_pressure, double post_pressure, double density, double conductivity,
                  double gamma, double centre);

  double shock_speed() const;      ///< w0
  double piston_velocity() const;  ///< of the gas far behind, w0 - w1
  double length_ahead() const;     ///< a
  double length_behind() const;    ///< b

  GasState at(double x, double t) const;
  double temperature(double x, double t) const;
  double flux(double x, double t) const;  ///< -K dT/dx

  /// Absolute accuracy of the velocity, relative to the shock's speed; of density, pressure and temperature,
  /// relative to those behind; at a given distance from the centre x_s(t).
  double accuracy() const;

 private:
  double logit(double x, double t) const;

  double initial_pressure_;
  double gamma_;
  double post_pressure_;
  double density_;
  double centre_;
  double mass_flux_;          // j
  double conduction_length_;  // l
};

}  // namespace sphverify::exact
