// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// Two layers of one density, 1 kg/m3, but different conductivity, between walls at fixed temperature.
///
///   dT/dt = d/dx (K dT/dx),   K = 1 in x < 1/2, K = contrast beyond,   T(0, t) = left,   T(1, t) = right
///   T = steady(x) + amplitude v(x) exp(-Kp (2 theta)^2 t)
///
/// Temperature and flux are continuous at x = 1/2. In the steady state the flux is
/// -(right - left)/(1/2 + 1/(2 contrast)), the same everywhere. Its slowest departure is, with the smaller
/// conductivity Kp, the larger Kg, S = sqrt(Kg/Kp) and z the distance from the wall of the poor layer,
///
///   v = sin(2 theta z)                                                in the poor layer, z <= 1/2,
///   v = sin(theta)/sin(theta/S) sin(2 theta (1-z)/S)                  in the good one;
///
/// both vanish at their walls, decay alike and join continuously, and the flux does where
///
///   cot(theta) + S cot(theta/S) = 0.
///
/// The slowest mode has its root in pi/2 <= theta < pi: pi/2 for S = 1, the half wave of a uniform slab, and
/// pi - pi/S^2 for large S, where the good layer is as good as a wall. In delta = pi - theta the condition is
/// tan(delta) = tan(theta/S)/S; delta less the angle of that tangent rises from below 0 to above it, with
/// a slope between 1 and 2, so that the root is accurate to rounding, delta itself too.
///
/// Separation of variables in composite slabs: Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959,
/// section 12.8; Ozisik, Heat Conduction, 2nd ed. 1993, chapter 7. Specific heat 1; lengths in m, t >= 0 in
/// s. Accurate to rounding, see accuracy().
class TwoLayer {
 public:
  TwoLayer(double left, double right, double contrast, double amplitude);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx; at x = 1/2 that of the right layer
  double flux(double x, double t) const;      ///< -K dT/dx, continuous
  double conductivity(double x) const;

  double phase() const;       ///< theta
  double decay_rate() const;  ///< Kp (2 theta)^2 [1/s]

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double shape(double x) const;
  double shape_slope(double x) const;
  double departure(double t) const;

  double left_;
  double right_;
  double contrast_;
  double amplitude_;
  double stretch_;  // S
  double delta_;
  double share_;  // sin(theta)/sin(theta/S)
};

}  // namespace sphverify::exact
