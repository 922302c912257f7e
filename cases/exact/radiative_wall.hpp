// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// A slab whose wall x = 1 radiates into an environment of fixed temperature, and whose wall x = 0 is
/// insulated. Manufactured: the wall's temperature is chosen, and a source keeps it so.
///
///   T_w(t)  = environment + (start - environment) exp(-t/cooling_time)
///   T(x, t) = T_w + (2/pi) G cos(pi x/2),   G = radiation (T_w^4 - environment^4)/K
///
/// cos(pi x/2) vanishes at x = 1 and has the slope 0 at x = 0 and -pi/2 at x = 1. Hence T(1, t) = T_w, no
/// heat passes x = 0, and what leaves through x = 1 is -K dT/dx = K G = radiation (T_w^4 - environment^4):
/// what a black wall of that temperature loses, if `radiation` is Stefan's constant. T solves dT/dt = (K/rho)
/// d2T/dx2 + source with
///
///   source = dT_w/dt + ((2/pi) dG/dt + (pi/2) (K/rho) G) cos(pi x/2),   dG/dt = 4 radiation T_w^3 dT_w/dt /
///   K.
///
/// Method of manufactured solutions: P. J. Roache, J. Fluids Eng. 124 (2002) 4; the fields are ours. Specific
/// heat 1; lengths in m, t >= 0 in s. Accurate to rounding, see accuracy().
class RadiativeWall {
 public:
  /// Expects temperatures that are not negative, start above environment.
  RadiativeWall(double radiation, double start, double environment, double cooling_time, double conductivity,
                double density);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;
  double source(double x, double t) const;  ///< heating per unit mass
  double wall_temperature(double t) const;  ///< T_w
  double radiated(double wall_temperature) const;

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double steepness(double t) const;  // G

  double radiation_;
  double start_;
  double environment_;
  double cooling_time_;
  double conductivity_;
  double density_;
};

}  // namespace sphverify::exact
