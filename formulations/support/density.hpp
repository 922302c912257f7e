#pragma once

#include <vector>

#include "formulations/support/cell_grid.hpp"
#include "formulations/support/smoothing_length.hpp"
#include "formulations/support/walls.hpp"

namespace sphverify {

/// Where a particle's density comes from.
enum class DensityRule {
  given,       ///< set by the case at the particle's position
  summation,   ///< sum_j m_j W_ij with j = i: halves at a wall (Campbell 1989, Eq. 5)
  normalised,  ///< summation / Gamma_i, the part of the kernel inside the fluid
  continuity   ///< integrated in time from the continuity equation (formulations/density/continuity.hpp)
};

/// sum_j m_j W_ij, the particle itself included (Campbell 1989, Eq. 4).  [kg/m^Dim]
template <int Dim>
std::vector<double> summation_density(CellGrid<Dim> const& grid, SmoothingLength const& h,
                                      std::vector<double> const& mass);

/// Gamma at a point: 1 - sum over walls of the part of the kernel beyond each. Exact while no two walls'
/// outer sides overlap within the support (parallel walls; not corners).
template <int Dim>
double kernel_inside(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double smoothing_length);

}  // namespace sphverify
