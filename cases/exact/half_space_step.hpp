// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// Half space x >= 0 at uniform temperature whose wall at x = 0 jumps to another one at t = 0.
///
///   rho dT/dt = K d2T/dx2,   T(0, t) = wall,   T(x, 0) = initial
///   T(x, t) = initial + (wall - initial) erfc(x / (2 sqrt(K t / rho)))
///
/// Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, chapter II. At t = 0 it is `initial`
/// in x > 0 and `wall` at the wall, where the gradient is infinite. Specific heat 1; T in units of energy per
/// mass, t >= 0 in s, x in m. Accurate to rounding, see accuracy().
class HalfSpaceStep {
 public:
  HalfSpaceStep(double wall, double initial, double conductivity, double density);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx; infinite at x = 0, t = 0 unless wall equals initial

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double wall_;
  double initial_;
  double diffusivity_;
};

}  // namespace sphverify::exact
