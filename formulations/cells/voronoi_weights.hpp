// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "formulations/cells/voronoi_cells.hpp"
#include "formulations/pair_geometry.hpp"

namespace sphverify {

/// How strongly two particles are coupled.
enum class PairWeight {
  kernel,  ///< W'(r)/r, and face weights at walls
  voronoi  ///< by the faces of their Voronoi cells, which close on any particles
};

/// The pairs that share a face, with what stands for W'(r)/r between them:
///
///   R_ij = -a_ij / (2 V_i V_j r_ij),   V = m/rho,
///
/// so that 2 V_i V_j times the slope is minus the face's area over the distance, as the sum over neighbours of Brookshaw's form
/// (Campbell 1989, Eq. 63) has it. Conductances on such cells are two-point fluxes of finite volumes: Eymard, Gallouet &
/// Herbin 2000. Of particles at a place nothing enters but mass and density. Offsets of the faces come along where the cells
/// have them.
/// @param cells whose faces, areas and offsets are taken over
template <int Dim>
NeighbourList voronoi_pairs(VoronoiCells<Dim>&& cells, VectorField<Dim> const& positions, Domain<Dim> const& domain,
                            std::vector<double> const& mass, std::vector<double> const& density, int threads);

/// Contacts of the particles whose cells have a face on a wall: A_i = a_iB / (2 V_i), and as density at the foot point the
/// particle's own, so that uniform pressure pushes nothing wherever faces close. What closures interpolate they
/// interpolate with the kernel, as beside any face weight.
/// @param index of the wall in all_walls
template <int Dim>
WallContacts<Dim> voronoi_contacts(WallFaces<Dim> const& faces, CellGrid<Dim> const& grid, std::vector<Wall<Dim>> const& all_walls,
                                   std::size_t index, SmoothingLength const& h, std::vector<double> const& mass,
                                   std::vector<double> const& density);

/// Makes the pairs, and the contacts with `geometry.walls`, those of the cells.
/// @param cells of all these walls; may have no others where there are some
/// @param grid whose reach holds the largest support
template <int Dim>
void weigh_by_cells(PairGeometry<Dim>& geometry, VoronoiCells<Dim>&& cells, CellGrid<Dim> const& grid, SmoothingLength const& h,
                    std::vector<double> const& mass, std::vector<double> const& density, int threads);

}  // namespace sphverify
