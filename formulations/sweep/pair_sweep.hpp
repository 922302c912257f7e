// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/scheme.hpp"
#include "formulations/sweep/loops.hpp"

namespace sphverify {

/// One pass over all pairs that computes any number of terms at once: separations, distances and the kernel are
/// computed once for all of them, batch by batch. Gathers the fields that the terms read, and no others. A row
/// is summed by one thread from start to end, so that results do not depend on the number of threads.
template <int Dim>
class PairSweep {
 public:
  PairSweep(NeighbourList const& neighbours, Domain<Dim> const& domain, int threads)
      : neighbours_(neighbours), domain_(domain), threads_(threads) {}

  /// Adds a term, whose loops must live until `run`. Its results go to particle i's place in `out`, component by component.
  /// @param reads fields of both particles, beside position
  /// @param parameters must live until `run`
  void add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, std::vector<double>& out,
           void const* parameters = nullptr);
  void add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, VectorField<Dim>& out);
  void add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, TensorField<Dim>& out);
  /// The same for a term of several components.
  void add(TermLoops const& loops, FieldSet reads, KernelWeightSet kernel, std::vector<double*> const& out,
           void const* parameters);

  bool empty() const { return terms_.empty(); }

  /// Computes all terms.
  /// @param state_velocity what terms that read `u` take, where that is not the field velocity
  void run(Particles<Dim> const& particles, VectorField<Dim> const* state_velocity = nullptr);

  /// Conductances of all pairs, in the order of the neighbour list, for a scheme that is a difference form.
  std::vector<double> conductances(void (*of_batch)(Batch const&, double*), FieldSet reads,
                                   Particles<Dim> const& particles);

 private:
  struct Records;

  SweepPlan plan(Particles<Dim> const& particles, Records const& records) const;
  void choose_loops(RecordSlots const& slots);

  NeighbourList const& neighbours_;
  Domain<Dim> const& domain_;
  int threads_;
  FieldSet reads_;
  bool wants_separation_ = false, wants_radial_ = false, wants_value_ = false, wants_offset_ = false, wants_own_radial_ = false;
  std::vector<RowTerm> terms_;
  std::vector<BatchFunction> loops_;     ///< of all terms
  std::vector<std::size_t> loop_terms_;  ///< at which term each begins
};

extern template class PairSweep<1>;
extern template class PairSweep<2>;
extern template class PairSweep<3>;

}  // namespace sphverify
