// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// Uniform slab 0 <= x <= 1 m heated by a constant flux q into its left wall, insulated at the right.
///
///   rho dT/dt = K d2T/dx2,   -K dT/dx = q at x = 0,   dT/dx = 0 at x = 1,   T(x, 0) = initial
///
/// With kappa = K/rho and l = 2 sqrt(kappa t), two series that are equal for every t > 0 (Carslaw & Jaeger,
/// Conduction of Heat in Solids, 2nd ed. 1959, section 3.8, where x counts from the insulated wall):
///
///   by modes   T = initial + q t / rho
///                + (q/K) [ ((1-x)^2)/2 - 1/6 - (2/pi^2) sum_{n>=1} n^-2 exp(-(n pi)^2 kappa t) cos(n pi x) ]
///   by images  T = initial + (q/K) l sum_{n>=0} [ ierfc((2n + x)/l) + ierfc((2n + 2 - x)/l) ]
///
/// where ierfc(z) = exp(-z^2)/sqrt(pi) - z erfc(z). Modes converge fast at late, images at early times;
/// temperature() and gradient() take images up to kappa t = 0.1, where either needs fewer than ten terms.
/// Time 0 gives the initial state, in which the gradient is zero in x > 0 and -q/K at the wall x = 0.
///
/// Specific heat 1; T in units of energy per mass, q in energy per area and s, t >= 0 in s, x in m. Accurate
/// to rounding, see accuracy().
class SlabFlux {
 public:
  SlabFlux(double initial, double flux, double conductivity, double density);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx

  // Either series by itself, converged in the range of times named beside it.
  double temperature_by_modes(double x, double t) const;   ///< for kappa t >= 0.01
  double temperature_by_images(double x, double t) const;  ///< for kappa t <= 10
  double gradient_by_modes(double x, double t) const;      ///< for kappa t >= 0.01
  double gradient_by_images(double x, double t) const;     ///< for kappa t <= 10

  /// Absolute accuracy of the temperature while q t / rho is at most max(1, |initial|).
  double accuracy() const;

 private:
  bool is_early(double t) const;

  double initial_;
  double flux_;
  double conductivity_;
  double density_;
};

}  // namespace sphverify::exact
