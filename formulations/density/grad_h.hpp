// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/neighbours/cell_grid.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Omega_i, by which a density that is summed with a smoothing length that follows it changes less than with one that stays
/// (Springel & Hernquist 2002; Price 2012, J. Comput. Phys. 231, 759).  [1]
///
///   drho_i = (drho_i at fixed h)/Omega_i  where  h_i = ratio (m_i/rho_i)^(1/Dim)
///   Omega_i = 1 + h_i/(Dim rho_i) drho_i/dh_i at fixed places
///           = [ -sum_j m_j r_ij . grad_i W(r_ij, h_i)/rho_i + sum_B d_i A_i ] / (Dim Gamma_i)
///
/// The second line follows from h dW/dh = -Dim W - r dW/dr, with rho_i = sum_j m_j W(r_ij, h_i)/Gamma_i (j = i included), and
/// from h dGamma/dh = -sum_B d_i dGamma/dd_i = -sum_B d_i A_i: Gamma knows of lengths over h alone, and A_i, the kernel's
/// integral over a wall's face, is its derivative by that wall's distance. So a uniform gas has Omega = 1 up to its walls, but
/// for what the sums are off. Positive wherever another particle or a wall is within the support.
/// @param h each particle's own
/// @param density summed with these h
/// @param walls that it is normalised by; empty: Gamma = 1
template <int Dim>
std::vector<double> grad_h_terms(CellGrid<Dim> const& grid, SmoothingLength const& h, std::vector<double> const& mass,
                                 std::vector<double> const& density, std::vector<Wall<Dim>> const& walls, int threads);

}  // namespace sphverify
