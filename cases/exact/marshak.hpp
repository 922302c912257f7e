// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace sphverify::exact {

/// Self-similar heat wave (Marshak wave) from a wall at T = 1 into a medium at T = 0.
///
///   dT/dt = d/dx (K dT/dx),   K(T) = T^n,   rho = 1,   T(0, t) = 1,   T(x, 0) = 0,   n > 0
///   T(x, t) = f(xi),   xi = x / sqrt(t),   (f^n f')' + xi f'/2 = 0,   f(0) = 1,   f = 0 from xi_f on
///
/// R. E. Marshak, Phys. Fluids 1 (1958) 24; G. I. Barenblatt, Prikl. Mat. Mekh. 16 (1952) 67;
/// Ya. B. Zel'dovich & Yu. P. Raizer, Physics of Shock Waves and High-Temperature Hydrodynamic Phenomena,
/// chapter X.
///
/// Derivation. w = f^n obeys w w'' + w'^2/n + xi w'/2 = 0, which is free of the front's root singularity, and
/// w = xi_f^2 g(s) with s = 1 - xi/xi_f removes xi_f from it:
///
///   g g'' + g'^2/n - (1 - s) g'/2 = 0,   g(0) = 0.
///
/// Its solution that leaves the front with g' > 0 is analytic there, g = sum_{k>=1} g_k s^k. Orders 0
/// and j are
///
///   g_1 = n/2,
///   (j+1) (j n + 1)/2 g_{j+1} = - j g_j/2 - sum_{i=2..j} (k (k-1) + i k/n) g_i g_k   with k = j + 2 - i,
///
/// so g_2 = -n/(4(n+1)). The terms fall off so fast, at the wall s = 1 too, that double precision needs 14 of
/// them at n = 3 and 59 at n = 0.1: the series is the solution everywhere, with no integration and no root
/// search. The wall's value then fixes the front, 1 = w(0) = xi_f^2 g(1), and f = (g(s)/g(1))^(1/n).
/// sqrt(n) xi_f lies between sqrt(2), for large n, and 2, for small n; xi_f = 0.870570756096995 for n = 3.
/// The energy in the medium, which came through the wall, is the integral of T dx = -2 f'(0) sqrt(t).
///
/// Specific heat 1; x in m, t >= 0 in s. At t = 0 it is 0 in x > 0 and 1 at the wall, where gradient and flux
/// are infinite. xi_f is accurate to 1e-14 relative for n >= 0.01, 1e-13 below. For the temperature see
/// accuracy(), which holds at points farther from the front than 1e-4 of its position; nearer, where dT/dx
/// grows without bound if n > 1, it is the exact temperature of a point displaced by at most 1e-14 of that
/// position.
class Marshak {
 public:
  /// Throws BadValue too where the series needs more terms than we take, below about n = 0.0005.
  explicit Marshak(double exponent);

  double temperature(double x, double t) const;
  double gradient(double x, double t) const;  ///< dT/dx behind the front, 0 at and beyond it
  double front(double t) const;
  double front_constant() const;        ///< xi_f
  double wall_flux(double t) const;     ///< -K dT/dx at x = 0, heat that enters per area and second
  double total_energy(double t) const;  ///< per area
  double conductivity(double temperature) const;

  /// Absolute accuracy of the temperature, away from the front (see above).
  double accuracy() const;

 private:
  double depth(double x, double t) const;
  double shape(double s) const;
  double shape_slope(double s) const;
  double wall_slope() const;

  double exponent_;
  std::vector<double> coefficients_;  // g_0 = 0, g_1, ...
  double front_constant_;
};

}  // namespace sphverify::exact
