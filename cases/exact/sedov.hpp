// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cases/exact/gas_state.hpp"

namespace sphverify::exact {

/// Sedov's explosion: energy E released on a plane, an axis or at a point drives a strong shock into uniform
/// gas at rest without pressure.
///
///   t = 0:   rho = rho0,   v_r = 0,   P = 0,   and E at r = 0;   P = (gamma - 1) rho e;   d the dimension
///   R(t) = (E t^2 / (alpha rho0))^(1/(d+2)),   D = dR/dt = delta R/t,   delta = 2/(d+2),   xi = r/R
///
/// L. I. Sedov, Similarity and Dimensional Methods in Mechanics (1959), chapter IV; L. D. Landau & E. M.
/// Lifshitz, Fluid Mechanics, section 106, for d = 3; J. R. Kamm & F. X. Timmes, LA-UR-07-2849 (2007).
///
/// Derivation. Let v = delta (r/t) V, c^2 = delta^2 (r/t)^2 Z and rho = rho0 g, functions of xi. The surface
/// where xi has a given value moves at delta r/t. As mass and energy within it grow as R^d and not at all,
///
///   M = S_d rho r^d (1 - V)/d                                     S_d = 2, 2 pi, 4 pi
///   Z = gamma (gamma - 1) (1 - V) V^2 / (2 (gamma V - 1)).
///
/// A shell keeps P/rho^gamma, which falls as D^2 from shell to shell, so as 1/M:
///
///   g^(2-gamma) xi^(d+2) Z (1 - V) = constant,   and by continuity   (1 - V) (ln g)' = V' + d V
///
/// with ' = d/d(ln xi). Elimination of g leaves
///
///   d(ln xi)/dV = (gamma (gamma+1) V^2 - 2 (gamma+1) V + 2) / (V (gamma V - 1) A),
///   A = (d+2) - s V,   s = 2 + d (gamma-1),
///
/// positive throughout: the numerator has no real zero, and V runs from 1/gamma at the centre to 2/(gamma+1)
/// at the shock. With a hat for the ratio to the value at the shock, B = gamma V - 1, C = 1 - V and
/// q = 2 gamma + d - 2, partial fractions give
///
///   xi = V^^(-delta) A^^a B^^b,   b = (gamma-1)/q,   a = delta - (gamma+1)/s - b
///   g^ = B^^(d/q) C^^-k exp(-(d+2) a L),   k = (d-2) ((d-2) gamma - 3 d + 2)/(s q)
///   P^ = V^^(2-2 delta) A^^(2 a) C^^(1-k) exp(-(d+2) a L),   L = ln(A^/C^)/(2 - gamma)
///
/// where L has the limit (d/(d+2)) (V/(1-V) - 2/(gamma-1)) for gamma = 2, so that this gamma is none apart.
/// Next to the centre B falls as xi^(1/b) and the density with it as xi^(d/(gamma-1)), while P stays.
/// At the shock, g = (gamma+1)/(gamma-1), v = 2 D/(gamma+1) and P = 2 rho0 D^2/(gamma+1). The energy within,
///
///   alpha = delta^2 S_d integral_0^1 (g V^2 xi^2/2 + P/((gamma-1) rho0 D^2)) xi^(d-1) dxi,
///
/// is found by quadrature. It is 1.077486, 0.984074 and 0.851072 in 1D, 2D and 3D for gamma = 1.4.
///
/// E counts both sides of the plane, per area, or all round the axis, per length. Lengths in m, times in s,
/// densities in kg/m3.
class Sedov {
 public:
  /// dimension: 1, 2 or 3. Throws BadValue too for gamma >= 7 in 3D, where no gas reaches the
  /// centre.
  Sedov(int dimension, double gamma, double density, double energy);

  /// r, t >= 0; the velocity is radial. At r = 0 and t > 0 the density is 0 and the pressure that of the
  /// centre.
  GasState at(double r, double t) const;

  double shock_radius(double t) const;
  double shock_speed(double t) const;      ///< t > 0
  double shock_time(double radius) const;  ///< when the shock is there

  /// alpha, in E = alpha rho0 R^(d+2)/t^2
  double energy_constant() const;

  /// Relative accuracy of density, velocity and pressure at r > R/10 (in 3D for gamma < 6.5), away from the
  /// shock, which stands within 1e-12 R of where it should.
  double accuracy() const;

 private:
  /// The profile at one place, relative to the shock but for V.
  struct Shape {
    double log_xi;
    double V;
    double density;   // g^
    double pressure;  // P^
  };
  Shape shape(double log_b) const;
  double log_b_at(double log_xi) const;
  double energy_integral() const;

  int dimension_;
  double gamma_;
  double density_;
  double energy_;
  double delta_, s_, a_, b_, k_;  // as above
  double alpha_;
};

}  // namespace sphverify::exact
