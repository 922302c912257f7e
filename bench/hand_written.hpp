// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Loops as one writes them by hand for one task only: raw arrays, one thread, 3D, the cubic spline with one
/// smoothing length, no walls. What the product's sweeps are measured against, so they share nothing with
/// them.
namespace sphverify::bench::hand_written {

/// Particles in cells of at least the reach, numbered cell by cell, x fastest.
struct Cells {
  std::array<std::size_t, 3> count;  ///< of cells along x, y, z
  std::vector<std::uint32_t> first;  ///< per cell and one more: where its particles start
  std::vector<std::uint32_t> order;  ///< of particle k, its number before
  std::vector<double> x, y, z;       ///< positions in the new order [m]
};

/// Directed pairs: row i holds the neighbours first[i] to first[i+1], ascending. `neighbour` goes on beyond
/// first.back() with at least four valid numbers, so that loops may read four at a time, and with room to be
/// filled again without allocation.
struct Rows {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> neighbour;

  std::size_t size() const { return first.size() - 1; }
  std::size_t pairs() const { return first.back(); }
};

/// Counting sort of n particles. The vectors of `cells` are reused.
void sort_into_cells(std::size_t n, double const* x, double const* y, double const* z, double reach,
                     Cells& cells);

/// All pairs closer than the reach that the cells were made for; numbers are those of `cells`.
void build_rows_scalar(Cells const& cells, double reach, Rows& rows);

/// The same; each cell copies the candidates of its particles once, then tests them in vectors and appends
/// without branches.
void build_rows_vectorised(Cells const& cells, double reach, Rows& rows);
/// The same without instructions of AVX2, as other processors get it.
void build_rows_portable(Cells const& cells, double reach, Rows& rows);

/// Heat conduction (Brookshaw): q_i = sum_j m_j (K_i + K_j)/(rho_i rho_j) (T_i - T_j) W'(r)/r.  [W/kg]
struct Conduction {
  double const *x, *y, *z, *m, *rho, *T, *K;
  double h;
};
void conduction_scalar(Rows const& rows, Conduction const& in, double* q);
/// Four neighbours at a time, each field gathered from its array.
void conduction_gathered(Rows const& rows, Conduction const& in, double* q);
/// Four at a time from packed records, which are made first. @param records scratch
void conduction_vectorised(Rows const& rows, Conduction const& in, std::vector<double>& records, double* q);

/// rho_i = sum_j m_j W(r), the particle itself included.  [kg/m^3]
struct Density {
  double const *x, *y, *z, *m;
  double h;
};
void density_scalar(Rows const& rows, Density const& in, double* rho);
/// @param records scratch
void density_vectorised(Rows const& rows, Density const& in, std::vector<double>& records, double* rho);

/// Acceleration by pressure (P/rho^2) and Monaghan's viscosity, and the change of internal energy by both:
///
///   a_i = -sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2 + Pi_ij) grad_i W                              [m/s^2]
///   u_i =  sum_j m_j (P_j/rho_j^2 + Pi_ij/2) (v_i - v_j).grad_i W                              [W/kg]
///   Pi_ij = (-alpha c mu + beta mu^2)/rho, mu = h v_ij.r_ij/(r_ij^2 + 0.01 h^2) where that is negative, else
///   0
struct Euler {
  double const *x, *y, *z, *vx, *vy, *vz, *m, *rho, *P, *c;
  double h, alpha, beta;
};
struct EulerRates {
  double *ax, *ay, *az, *u;
};
void euler_scalar(Rows const& rows, Euler const& in, EulerRates const& out);
/// @param records scratch
void euler_vectorised(Rows const& rows, Euler const& in, std::vector<double>& records, EulerRates const& out);

/// Frozen particles: q_i = sum_j weight_ij (T_i - T_j), one weight for each entry of rows.neighbour.
void stored_scalar(Rows const& rows, double const* weight, double const* T, double* q);
void stored_vectorised(Rows const& rows, double const* weight, double const* T, double* q);
/// The same with gathers, which are fast on some processors.
void stored_gathered(Rows const& rows, double const* weight, double const* T, double* q);

/// a = b + s c over n numbers (McCalpin's STREAM triad): 24 bytes each, not counting that a is fetched too.
void triad(std::size_t n, double s, double const* b, double const* c, double* a);
/// The sum of n numbers: what reading alone achieves.
double sum(std::size_t n, double const* a);

}  // namespace sphverify::bench::hand_written
