// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "formulations/pair_geometry.hpp"
#include "formulations/sweep/pair_sweep.hpp"

// What a sweep hands to the terms of every pair, looked at from outside.
namespace sphverify::tests {

/// One entry per directed pair, in the order of the neighbour list.
template <int Dim>
struct GatheredPairs {
  VectorField<Dim> separation;         ///< r_i - r_j [m]
  std::vector<double> distance;        ///< [m]
  std::vector<double> radial;          ///< W'(r)/r  [m^-(Dim+2)]
  bool whole_packs = true;             ///< rows are filled up to them
  bool idle_lanes_add_nothing = true;  ///< those that fill a row up have no slope

  Vector<Dim> gradient(std::size_t pair) const { return radial[pair] * separation[pair]; }
};

/// A term of a sweep that copies what it sees, wherever rows lie in batches.
template <int Dim>
class PairProbe {
 public:
  PairProbe(NeighbourList const& list, GatheredPairs<Dim>& out) : list_(list), out_(out) {}

  static void look(Batch const& batch, RowTerm const* term) { (*static_cast<PairProbe* const*>(term->parameters))->copy(batch); }

 private:
  void copy(Batch const& batch) {
    for (std::size_t row = 0; row < batch.rows; ++row) {
      std::size_t const listed = list_.first[batch.begin + row];
      std::size_t const count = list_.first[batch.begin + row + 1] - listed;
      std::size_t const from = batch.first[row];
      std::size_t const padded = batch.first[row + 1] - from;
      for (std::size_t k = 0; k < count; ++k) {
        Vector<Dim> r;
        for (std::size_t n = 0; n < Dim; ++n) r[static_cast<int>(n)] = batch.separation[n * batch.capacity + from + k];
        out_.separation.set(listed + k, r);
        out_.distance[listed + k] = batch.distance[from + k];
        out_.radial[listed + k] = batch.radial[from + k];
      }
      for (std::size_t k = count; k < padded; ++k)
        out_.idle_lanes_add_nothing = out_.idle_lanes_add_nothing && batch.radial[from + k] == 0.0;
      out_.whole_packs = out_.whole_packs && padded % 4 == 0 && padded >= count && padded < count + 4;
    }
  }

  NeighbourList const& list_;
  GatheredPairs<Dim>& out_;
};

template <int Dim>
GatheredPairs<Dim> gathered_pairs(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry) {
  std::size_t const pairs = geometry.neighbours.pairs();
  GatheredPairs<Dim> gathered{VectorField<Dim>(pairs), std::vector<double>(pairs),
                              std::vector<double>(pairs)};
  PairProbe<Dim> probe(geometry.neighbours, gathered);
  PairProbe<Dim>* const parameters = &probe;
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, 1);
  TermLoops const look{.sum = PairProbe<Dim>::look};
  sweep.add(look, {}, {KernelWeight::gradient, KernelWeight::radial}, std::vector<double*>{},
            &parameters);
  sweep.run(particles);
  return gathered;
}

}  // namespace sphverify::tests
