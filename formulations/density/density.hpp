// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/particles/smoothing_length.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// Where a particle's density comes from.
enum class DensityRule {
  given,       ///< set by the case at the particle's position
  summation,   ///< sum_j m_j W_ij with j = i: halves at a wall (Campbell 1989, Eq. 5)
  normalised,  ///< summation / Gamma_i, the part of the kernel inside the fluid
  continuity,  ///< integrated in time from the continuity equation (formulations/density/continuity.hpp)
  voronoi      ///< m_i over the volume of the particle's Voronoi cell (formulations/cells/voronoi_cells.hpp)
};

/// sum_j m_j W_ij, the particle itself included (Campbell 1989, Eq. 4).  [kg/m^Dim]
/// Where every particle may have its own smoothing length; gathers with that of the particle itself.
template <int Dim>
std::vector<double> summation_density(CellGrid<Dim> const& grid, SmoothingLength const& h,
                                      std::vector<double> const& mass, int threads = 1);

/// The same into the field density, over a neighbour list; all have the common smoothing length.
template <int Dim>
void sum_density(Particles<Dim>& particles, NeighbourList const& neighbours, Domain<Dim> const& domain,
                 int threads);

/// Gamma at a point: the part of the kernel on the inner sides of all walls, in corners too
/// (formulations/walls/finite_face.hpp).
template <int Dim>
double kernel_inside(Vector<Dim> const& x, std::vector<Wall<Dim>> const& walls, double smoothing_length,
                     Kernel const& kernel);

}  // namespace sphverify
