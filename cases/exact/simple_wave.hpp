// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// A piston sets gas at rest in x > 0 in motion smoothly, seen before the shock forms.
///
///   u_p(t) = speed sin^2(pi t / (2 rise_time)) until rise_time, `speed` from then on
///   x_p(t) = integral of u_p from 0 to t
///
/// Every state lies on the straight C+ characteristic that left the piston at its time tau in [0, t]:
///
///   u = u_p(tau),   c = c0 + (gamma-1)/2 u,   x = x_p(tau) + (u + c) (t - tau)
///
/// with the entropy and the invariant u - 2c/(gamma-1) of the gas at rest, which lies ahead of x = c0 t.
/// L. D. Landau & E. M. Lifshitz, Fluid Mechanics (1987), section 101; G. B. Whitham, Linear and Nonlinear
/// Waves (1974), section 6.8. Derivatives of second order jump at x = c0 t and where tau = rise_time.
///
/// Neighbouring characteristics meet where dx/dtau = 0, at
///
///   t(tau) = tau + 2 c / ((gamma+1) u_p'(tau)),
///
/// and the shock forms at the smallest of these times: t(tau) has one minimum, where gamma u_p'^2 = c u_p'',
/// which is a quadratic equation for q = cos(pi tau / rise_time):
///
///   (gamma+1) speed q^2 + (4 c0 + (gamma-1) speed) q - 2 gamma speed = 0,   0 < q < 1.
///
/// A negative speed expands the gas, and no shock forms; it must stay above -2 c0/(gamma-1), where a vacuum
/// would open. Points behind the piston have the piston's state. Times are t >= 0.
class SimpleWave {
 public:
  SimpleWave(double speed, double rise_time, double density, double pressure, double gamma);

  double piston_position(double t) const;
  double piston_velocity(double t) const;
  double shock_formation_time() const;  ///< infinite unless the piston compresses

  /// Throws BadValue after the shock's formation.
  GasState at(double x, double t) const;

  /// Absolute accuracy of the velocity up to 0.9 of the formation time, and of density and pressure relative
  /// to the gas at rest. Later, where the profile steepens without bound, the state is that of a point
  /// displaced by rounding.
  double accuracy() const;

 private:
  double characteristic(double tau, double t) const;
  double departure(double x, double t) const;

  double rise_time_;
  double gamma_;
  GasState rest_;
  double rest_sound_speed_;
  double speed_;
};

}  // namespace sphverify::exact
