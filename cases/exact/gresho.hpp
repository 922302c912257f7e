// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// Gresho's vortex: gas of density 1 that turns about the origin for ever, each circle held by the pressure
/// outside of it. P. M. Gresho & S. T. Chan, Int. J. Numer. Methods Fluids 11 (1990) 621; R. Liska & B.
/// Wendroff, SIAM J. Sci. Comput. 25 (2003) 995. As the Mach number falls: F. Miczek, F. K. Roepke & P. V. F.
/// Edelmann, Astron. Astrophys. 576 (2015) A50.
///
///   v = 5 r,       P = P0 + 12.5 r^2                               r <= 0.2
///   v = 2 - 5 r,   P = P0 + 4 + 12.5 r^2 - 20 r + 4 ln(5 r)        r <= 0.4
///   v = 0,         P = P0 - 2 + 4 ln 2                             beyond
///
/// v is the velocity about the origin, counterclockwise, and dP/dr = v^2/r. Velocity and pressure are
/// continuous; the velocity has kinks where the formulas meet, so that the vorticity jumps there.
///
/// Lengths in m, velocities in m/s, pressures in Pa, density 1 kg/m3.
class Gresho {
 public:
  static constexpr double density = 1.0;
  static constexpr double fastest = 0.2;  ///< where the velocity is 1
  static constexpr double edge = 0.4;     ///< where it ends

  explicit Gresho(double central_pressure);

  /// P0 with which the largest Mach number of the vortex, at r = 0.2, is `mach`. It must be below
  /// sqrt(2/gamma) for the pressure to be positive.
  static double central_pressure(double gamma, double mach);

  // r >= 0
  double velocity(double r) const;
  double angular_velocity(double r) const;  ///< v/r, in 1/s; finite at the origin
  double pressure(double r) const;

  /// Relative accuracy of velocity, to its largest, and pressure.
  double accuracy() const;

 private:
  double central_pressure_;
};

}  // namespace sphverify::exact
