// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify::exact {

/// Barenblatt's compact solution of slow nonlinear diffusion, a heat pulse spreading into T = 0.
///
///   dT/dt = d2(T^m)/dx2 = d/dx (K dT/dx),   K(T) = m T^(m-1),   rho = 1,   m > 1
///   T(x, t) = tau^-a [ C - k x^2 tau^-2a ]_+^(1/(m-1)),   tau = start_time + t,
///   a = 1/(m+1),   k = (m-1) / (2 m (m+1))
///
/// G. I. Barenblatt, Prikl. Mat. Mekh. 16 (1952) 67; Ya. B. Zel'dovich & A. S. Kompaneets 1950; R. E. Pattle,
/// Q. J. Mech. Appl. Math. 12 (1959) 407; J. L. Vazquez, The Porous Medium Equation (2007), section 1.1.
/// The front, from which T = 0 on, stands at |x| = sqrt(C/k) tau^a. The flux -K dT/dx equals a x T / tau, so
/// that every point of the profile moves as x ~ tau^a, and the energy is
///
///   integral of T dx = C^(1/(m-1)) sqrt(C/k) B(1/2, m/(m-1)),   B the beta function.
///
/// Specific heat 1; times t > -start_time count from the start time, at which tau = start_time.
/// Accurate to rounding, see accuracy(), at points farther from the front than 1e-4 of its position; nearer,
/// where dT/dx grows without bound if m > 2, it is the exact temperature of a point displaced by at most
/// 1e-14 of that position.
class Barenblatt {
 public:
  Barenblatt(double exponent, double constant, double start_time);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx behind the front, 0 at and beyond it
  double flux(double x, double t) const;      ///< -K dT/dx = -d(T^m)/dx
  double front(double t) const;               ///< the positive front; the other one is its mirror image
  double conductivity(double temperature) const;
  double total_energy() const;  ///< over the whole line, per area; the same at all times

  /// Absolute accuracy of the temperature from t = 0 on, away from the front (see above).
  double accuracy() const;

 private:
  double elapsed(double t) const;
  double reach() const;

  double exponent_;
  double constant_;
  double start_time_;
  double spread_;     // a
  double curvature_;  // k
};

}  // namespace sphverify::exact
