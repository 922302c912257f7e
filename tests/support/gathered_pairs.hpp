#pragma once

#include <algorithm>
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
  bool whole_packs = true;             ///< parts of rows are filled up to them
  bool idle_lanes_add_nothing = true;  ///< those that fill a part up have no slope

  Vector<Dim> gradient(std::size_t pair) const { return radial[pair] * separation[pair]; }
};

/// A term of a sweep that copies what it sees. Rows come one after the other, each in parts.
template <int Dim>
class PairProbe {
 public:
  PairProbe(NeighbourList const& list, GatheredPairs<Dim>& out) : list_(list), out_(out) {}

  static void look(Row const& row, void const* probe, double*) {
    (*static_cast<PairProbe* const*>(probe))->copy(row);
  }

 private:
  void copy(Row const& row) {
    while (list_.first[row_ + 1] == next_) ++row_;
    std::size_t const count = std::min(part_size, list_.first[row_ + 1] - next_);
    for (std::size_t k = 0; k < count; ++k, ++next_) {
      Vector<Dim> r;
      for (int n = 0; n < Dim; ++n) r[n] = row.columns[static_cast<std::size_t>(n) * part_size + k];
      out_.separation.set(next_, r);
      out_.distance[next_] = row.distance[k];
      out_.radial[next_] = row.radial[k];
    }
    for (std::size_t k = count; k < row.count; ++k) {
      out_.idle_lanes_add_nothing = out_.idle_lanes_add_nothing && row.radial[k] == 0.0;
    }
    out_.whole_packs = out_.whole_packs && row.count % 4 == 0 && row.count >= count && row.count < count + 4;
  }

  NeighbourList const& list_;
  GatheredPairs<Dim>& out_;
  std::size_t row_ = 0, next_ = 0;  ///< the pair that comes next
};

template <int Dim>
GatheredPairs<Dim> gathered_pairs(Particles<Dim> const& particles, PairGeometry<Dim> const& geometry) {
  std::size_t const pairs = geometry.neighbours.pairs();
  GatheredPairs<Dim> gathered{VectorField<Dim>(pairs), std::vector<double>(pairs),
                              std::vector<double>(pairs)};
  PairProbe<Dim> probe(geometry.neighbours, gathered);
  PairProbe<Dim>* const parameters = &probe;
  PairSweep<Dim> sweep(geometry.neighbours, geometry.domain, 1);
  sweep.add(PairProbe<Dim>::look, {}, {KernelWeight::gradient, KernelWeight::radial}, std::vector<double*>{},
            &parameters);
  sweep.run(particles);
  return gathered;
}

}  // namespace sphverify::tests
