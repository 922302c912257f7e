// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formulations/neighbours/cell_grid.hpp"
#include "formulations/basics/large_array.hpp"
#include "formulations/neighbours/pair_support.hpp"
#include "formulations/particles/smoothing_length.hpp"

namespace sphverify {

/// Directed neighbour pairs in compressed rows: row i lists every j != i that is closer to i than some reach,
/// cell by cell as the grid that found them has them. Where pair weights are not the kernel's, row i lists those that
/// have one instead, with what stands for W'(r)/r between them.
struct NeighbourList {
  std::vector<std::size_t> first;       ///< rows + 1 offsets into `neighbour`
  LargeArray<std::uint32_t> neighbour;  ///< one entry per directed pair
  LargeArray<double> slope{};           ///< of each, in place of W'(r)/r [m^-(Dim+2)]; empty: the kernel's
  /// Of each, from the middle between both particles to the centroid of the face that they share, component by component [m];
  /// empty where no scheme reads it, or where there are no faces.
  std::array<LargeArray<double>, 3> offset{};

  std::size_t rows() const { return first.size() - 1; }
  std::size_t pairs() const { return neighbour.size(); }
  std::span<std::uint32_t const> row(std::size_t i) const {
    return {neighbour.data() + first[i], first[i + 1] - first[i]};
  }
  std::size_t bytes() const {
    return first.capacity() * sizeof(std::size_t) + neighbour.capacity() * sizeof(std::uint32_t) +
           (slope.capacity() + offset[0].capacity() + offset[1].capacity() + offset[2].capacity()) * sizeof(double);
  }
};

/// Whether every pair has its face's offset.
inline bool has_offsets(NeighbourList const& list, int dimension) {
  return list.offset[static_cast<std::size_t>(dimension - 1)].size() == list.pairs();
}

/// Every pair closer than the grid's reach.
/// @param old a list that is no longer needed: its memory is used again, which saves more than it seems,
/// since memory that is new costs as much as what is written to it
/// Throws std::invalid_argument when two particles are at the same place.
template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, int threads = 1, NeighbourList old = {});

/// The pairs closer than the support of their own smoothing length, by their mean or the larger of the two, times 1 + skin.
/// Expects the grid's reach to hold the largest. Throws std::invalid_argument when two particles are at the same place.
template <int Dim>
NeighbourList find_neighbours(CellGrid<Dim> const& grid, SmoothingLength const& h, double skin = 0.0,
                              int threads = 1, NeighbourList old = {}, PairSupport support = PairSupport::mean);

}  // namespace sphverify
