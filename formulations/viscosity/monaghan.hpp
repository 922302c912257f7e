// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace sphverify {

/// Monaghan's artificial viscosity (Monaghan & Gingold, J. Comput. Phys. 52 (1983) 374; Monaghan, Annu. Rev.
/// Astron. Astrophys. 30 (1992) 543, Eqs. 4.1-4.3).
///
///   Pi_ij = (-alpha c_ij mu_ij + beta mu_ij^2)/rho_ij where a pair approaches, else 0
///   mu_ij = h_ij v_ij.r_ij/(r_ij^2 + 0.01 h_ij^2)
///
/// with the means c_ij, rho_ij, h_ij of a pair.  [mu] = m/s, Pi in Pa/(kg/m^Dim)^2.
struct MonaghanViscosity {
  double alpha = 0.0;  ///< weight of the term linear in the approach
  double beta = 0.0;   ///< weight of the quadratic one

  bool is_on() const { return alpha != 0.0 || beta != 0.0; }

  template <class Number>
  struct Pair {
    Number mu, Pi;
  };
  /// (r_ij^2 + 0.01 h_ij^2) rho_ij: what mu/rho is divided by. Apart, because divisions are the dearest part
  /// of a vectorised sweep, which multiplies by its inverse.
  template <class Number>
  static Number divisor(Number squared_distance, Number h, Number rho) {
    return (squared_distance + 0.01 * h * h) * rho;
  }

  /// @param approach v_ij.r_ij, negative where the two approach  [m^2/s]
  /// @param h, c, rho the pair's means
  /// @param divisor the above, as something to divide by
  template <class Number>
  Pair<Number> pair(Number approach, Number h, Number c, Number rho, auto const& divisor) const {
    using std::min;
    Number const mu_per_rho = h * min(approach, Number(0.0)) / divisor;
    Number const mu = rho * mu_per_rho;
    return {mu, (-alpha * c + beta * mu) * mu_per_rho};
  }

  /// Of the terms linear and quadratic in the approach, for the step.
  double linear() const { return alpha; }
  double quadratic() const { return beta; }
};

}  // namespace sphverify
