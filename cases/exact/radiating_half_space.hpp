// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace sphverify::exact {

/// Half space x >= 0 at uniform temperature whose wall loses heat by its own temperature from t = 0 on.
///
///   rho dT/dt = K d2T/dx2,   K dT/dx = loss(T) at x = 0,   T(x, 0) = start
///   loss(T) = radiation (T^n - environment^n)
///
/// n = 4 is a black wall, n = 1 Newton's law of cooling. By Duhamel's theorem, from the temperature that a
/// heat pulse on the wall leaves (Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, sections 2.7
/// to 2.9; J. C. Jaeger, Proc. Camb. Phil. Soc. 46 (1950) 634, for the radiating wall),
///
///   T(x, t) = start - 1/sqrt(pi K rho) integral_0^t loss(T_w(s)) exp(-rho x^2/(4 K (t-s)))/sqrt(t-s) ds,
///
/// which at x = 0 is a Volterra equation of the second kind with a weakly singular kernel for T_w alone. In
/// units of T_m = max(start, environment), K/(radiation T_m^(n-1)) and its square times rho/K it has no
/// parameter but n and the two temperatures. With z = sqrt(t) and s = z^2 cos^2(psi) it reads
///
///   T_w(z) = start - 2/sqrt(pi) integral_0^(pi/2) loss(T_w(z cos(psi))) z cos(psi) dpsi:
///
/// nothing in it is singular, and T_w is analytic in z (C. Lubich, Math. Comp. 41 (1983) 87). So it is solved
/// by product integration on a graded mesh: on intervals of z that grow by half, loss and T_w are polynomials
/// of degree 16 through Chebyshev points, at which the equation holds; Newton's method does one interval
/// after the other. The field is the integral above by Gauss' rule, on panels that halve towards psi = 0
/// until the kernel is nothing.
///
/// Specific heat 1; x in m, t >= 0 in s, T in K. See accuracy().
class RadiatingHalfSpace {
 public:
  /// @param exponent n, 1 to 8
  /// Expects temperatures that are not negative and not both zero. Throws BadValue.
  RadiatingHalfSpace(double radiation, int exponent, double start, double environment, double conductivity,
                     double density);

  // Each throws std::invalid_argument for times beyond 1e10 of the unit above.
  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx
  double wall_temperature(double t) const;    ///< T_w

  /// Heat that a wall of this temperature loses; of negative ones as much is gained beyond the environment's,
  /// so that it rises everywhere.  [W/m^2]
  double lost(double wall_temperature) const;

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  static constexpr int degree = 16;
  using Values = std::array<double, degree + 1>;
  using OwnWeights = Eigen::Matrix<double, degree, degree + 1>;

  void solve();
  OwnWeights own_weights(std::size_t interval) const;
  double scaled_loss(double v) const;
  double scaled_time(double t) const;
  std::size_t interval_of(double z) const;
  double at_nodes(std::size_t interval, Values const& values, double z) const;
  template <class Kernel>
  double memory(double z, std::size_t intervals, double depth, Kernel const& kernel) const;

  double radiation_;
  int exponent_;
  double start_, environment_, conductivity_;
  double unit_;                      // of temperature
  double length_, time_;             // units
  std::vector<double> ends_;         // of the intervals of z, from 0
  std::vector<Values> wall_, loss_;  // at each interval's nodes
};

}  // namespace sphverify::exact
