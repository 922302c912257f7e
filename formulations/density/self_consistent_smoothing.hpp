// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/neighbours/cell_grid.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Smoothing lengths that suit the densities summed with them,
///
///   h_i = ratio (m_i/rho_i)^(1/Dim),  rho_i = sum_j m_j W(|r_i - r_j|, h_i) / Gamma(r_i, h_i),
///
/// j = i included. Every particle's equation holds its own h alone, and has one solution: each term of
/// h^Dim rho(h) rises with h (Price 2012, J. Comput. Phys. 231, 759, Section 2.3, solves the same one).
template <int Dim>
struct SelfConsistentSmoothing {
  VectorField<Dim> const& positions;  ///< [m]
  std::vector<double> const& masses;  ///< [kg]
  Domain<Dim> const& domain;
  std::vector<Wall<Dim>> const& walls;  ///< that densities are normalised by; empty: Gamma = 1
  double ratio;                         ///< h/dx
  int threads;
  Kernel const& kernel;

  /// Replaces a guess by the solution. [m] Round-off is all that the equations are missed by; of h that is
  /// 1e-13, but for particles so clumped that their own sum hardly depends on it.
  /// Throws std::invalid_argument, and leaves the guess as it was, where there is no solution (particles in
  /// one place; a ratio at which a particle's own term is too much: below W(0)^(1/Dim) at h = 1, which for
  /// the cubic spline is 0.667, 0.674 and 0.683 in 1, 2 and 3 dimensions, and below (2 W(0))^(1/Dim) on or
  /// outside a wall; a particle alone in the open), where a support would be wider than half a periodic box,
  /// or where a number is not finite.
  void solve(std::vector<double>& smoothing_length) const;
};

extern template struct SelfConsistentSmoothing<1>;
extern template struct SelfConsistentSmoothing<2>;
extern template struct SelfConsistentSmoothing<3>;

}  // namespace sphverify
