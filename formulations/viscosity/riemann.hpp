// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace sphverify {

/// The viscous pressure of a Riemann problem between two particles that approach, in place of Monaghan's.
///
///   Pi_ij = 2 q/rho_ij^2,   q = rho_ij w [ b w + sqrt(b^2 w^2 + c_ij^2) ],   w = -v_ij.r_ij/(2 r_ij),   b =
///   (gamma + 1)/4
///
/// where the two approach, else 0; rho_ij and c_ij are means. q is by how much the pressure between two equal
/// states of an ideal gas that meet with speeds w and -w is above theirs (two shocks; Toro 2009,
/// Section 4.3.1, solved for the pressure), and sum_j m_j Pi_ij grad W adds it to both pressures of a form
/// such as P/rho^2, as Godunov SPH adds the star pressure (Inutsuka 2002; Parshikov & Medin 2002). It has no
/// coefficient to choose: alpha is 1 and beta (gamma + 1)/4 where h is the distance of a pair.
struct RiemannViscosity {
  double gamma = 0.0;  ///< ratio of specific heats; 0: off

  bool is_on() const { return gamma > 0.0; }

  template <class Number>
  struct Pair {
    Number mu, Pi;
  };
  /// r_ij rho_ij: what v_ij.r_ij/rho_ij is divided by for the speed of approach. Particles in one place have
  /// none.
  template <class Number>
  static Number divisor(Number squared_distance, Number h, Number rho) {
    using std::sqrt;
    return sqrt(squared_distance + 1e-18 * h * h) * rho;
  }

  /// @param approach v_ij.r_ij, negative where the two approach  [m^2/s]
  /// @param c, rho the pair's means
  /// @param divisor the above, as something to divide by
  template <class Number>
  Pair<Number> pair(Number approach, Number, Number c, Number rho, auto const& divisor) const {
    using std::min;
    using std::sqrt;
    Number const speed_per_rho = min(approach, Number(0.0)) / divisor;
    Number const speed = rho * speed_per_rho;
    Number const quadratic = (0.125 * (gamma + 1.0)) * speed;  // b w, negative
    return {speed, (quadratic - sqrt(quadratic * quadratic + c * c)) * speed_per_rho};
  }

  /// As Monaghan's coefficients, for the step: of the terms linear and quadratic in the approach.
  double linear() const { return 1.0; }
  double quadratic() const { return 0.25 * (gamma + 1.0); }
};

}  // namespace sphverify
