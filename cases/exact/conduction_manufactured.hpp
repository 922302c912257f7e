// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/basics/vector.hpp"

namespace sphverify::exact {

/// Manufactured conduction in the box [0, 1]^Dim, periodic along every axis but the first.
///
///   rho(r)    = 1.3 + 0.3 cos(b)
///   T(r, t)   = 2 + 0.6 x + A(t) sin(c),   A = (1 + exp(-t))/4
///   K(r, T)   = scale (1 + 0.3 sin(d)) (1/2 + T^2/10)
///
///   b = 0.9 + (1.7, -2 pi,  2 pi) . r
///   c = 0.4 + (2.3,  2 pi,  2 pi) . r
///   d = 0.7 + (3.1,  2 pi, -2 pi) . r        (of each vector the first Dim components)
///
/// Everything varies with place, K with the temperature too, and nothing is symmetric: T, its gradient and
/// its second derivative differ from wall to wall (in 1D none of them vanishes at either), and no two of the
/// gradients of rho, T and K are parallel. For t >= 0 1.5 <= T <= 3.1, 1 <= rho <= 1.6, 0.5 scale <= K <= 1.9
/// scale. At late times T becomes steady but not uniform.
///
/// The source that makes T a solution of dT/dt = (1/rho) div(K grad T) + source, heating per unit mass:
///
///   source = dT/dt - [ K lap T + (grad K at fixed T) . grad T + (dK/dT) |grad T|^2 ] / rho
///
/// where, with the wave vectors c' and d' of c and d,
///
///   dT/dt  = -exp(-t)/4 sin(c)        grad T = (0.6, 0, 0) + A cos(c) c'        lap T = -A sin(c) |c'|^2
///   dK/dT  = scale (1 + 0.3 sin(d)) T/5        grad K at fixed T = scale 0.3 cos(d) (1/2 + T^2/10) d'
///
/// Method of manufactured solutions: P. J. Roache, J. Fluids Eng. 124 (2002) 4; the fields are ours. Specific
/// heat 1; lengths in m, t >= 0 in s; temperature and source are exact to rounding, see accuracy().
template <int Dim>
class ConductionManufactured {
  static_assert(Dim >= 1 && Dim <= 3);

 public:
  explicit ConductionManufactured(double conductivity_scale);

  double temperature(Vector<Dim> const& r, double t) const;
  Vector<Dim> temperature_gradient(Vector<Dim> const& r, double t) const;
  double density(Vector<Dim> const& r) const;
  double conductivity(Vector<Dim> const& r, double temperature) const;
  Vector<Dim> flux(Vector<Dim> const& r, double t) const;  ///< -K grad T
  double source(Vector<Dim> const& r, double t) const;     ///< heating per unit mass

  /// Absolute accuracy of the temperature.
  double accuracy() const;

 private:
  double scale_;
};

}  // namespace sphverify::exact
