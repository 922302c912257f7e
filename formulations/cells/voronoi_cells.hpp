// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formulations/basics/large_array.hpp"
#include "formulations/neighbours/neighbours.hpp"
#include "formulations/walls/walls.hpp"

namespace sphverify {

/// The faces of cells that lie on one wall.
template <int Dim>
struct WallFaces {
  std::vector<std::uint32_t> particle;  ///< ascending
  std::vector<double> area;             ///< [m^(Dim-1)]
  std::vector<Vector<Dim>> offset;      ///< from the particle's foot point to the face's centroid [m]; if asked for
};

/// Voronoi cells of particles: each holds what is nearer to its particle than to any other and on the inner sides of
/// all walls. A cell is a convex body between the planes halfway to its neighbours and the walls; so its faces close,
///
///   sum_j a_ij n_ij + sum_B a_iB n_B = 0,
///
/// and along a periodic axis a cell has those of images too. With x_f from the particle to a face's centroid (halfway to the
/// neighbour and on by the offset, or to the foot point on the wall and on),
///
///   sum_f a_f x_f n_f^T = V I
///
/// by the divergence theorem.
template <int Dim>
struct VoronoiCells {
  NeighbourList faces;           ///< row i: the particles with which i shares a face
  LargeArray<double> area;       ///< a_ij = a_ji of each, in the order of `faces`  [m^(Dim-1)]
  /// From the middle between both particles to the centroid of their face, the same from both sides; per component, if asked for.
  std::array<LargeArray<double>, Dim> offset{};  ///< [m]
  std::vector<double> volume;                    ///< [m^Dim]
  std::vector<WallFaces<Dim>> walls;             ///< one per wall
};

/// Finds the cells of all particles.
/// Throws std::invalid_argument, and names the first particle of which it is true, where two particles are at the same
/// place, one is on or outside a wall, a cell is unbounded (the fluid has a free side), or a periodic axis has so few
/// particles that a cell meets two images of a neighbour, or one that is not the nearest.
template <int Dim>
VoronoiCells<Dim> find_voronoi_cells(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                     std::vector<Wall<Dim>> const& walls, int threads, bool with_offsets = false);

/// Their volumes alone.  [m^Dim]
template <int Dim>
std::vector<double> voronoi_volumes(VectorField<Dim> const& positions, Domain<Dim> const& domain,
                                    std::vector<Wall<Dim>> const& walls, int threads);

}  // namespace sphverify
