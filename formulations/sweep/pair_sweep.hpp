#pragma once

#include <memory>
#include <vector>

#include "formulations/neighbours/neighbours.hpp"
#include "formulations/scheme.hpp"
#include "formulations/sweep/dispatch.hpp"

namespace sphverify {

/// One pass over all pairs that computes any number of terms at once: a row's neighbours are gathered, and
/// the kernel evaluated, once for all of them. Gathers the fields that the terms read, and no others. A row
/// is summed by one thread from start to end, so that results do not depend on the number of threads.
template <int Dim>
class PairSweep {
 public:
  PairSweep(NeighbourList const& neighbours, Domain<Dim> const& domain, int threads)
      : neighbours_(neighbours), domain_(domain), threads_(threads) {}

  /// Adds a term. Its results go to particle i's place in `out`, component by component.
  /// @param reads fields of both particles, beside position
  /// @param parameters must live until `run`
  void add(RowFunction sum, FieldSet reads, KernelWeightSet kernel, std::vector<double>& out,
           void const* parameters = nullptr);
  void add(RowFunction sum, FieldSet reads, KernelWeightSet kernel, VectorField<Dim>& out);
  void add(RowFunction sum, FieldSet reads, KernelWeightSet kernel, TensorField<Dim>& out);
  /// The same for a term of several components.
  void add(RowFunction sum, FieldSet reads, KernelWeightSet kernel, std::vector<double*> const& out,
           void const* parameters);

  bool empty() const { return terms_.empty(); }

  /// Computes all terms.
  /// @param state_velocity what terms that read `u` take, where that is not the field velocity
  void run(Particles<Dim> const& particles, VectorField<Dim> const* state_velocity = nullptr);

  /// Conductances of all pairs, in the order of the neighbour list, for a scheme that is a difference form.
  std::vector<double> conductances(void (*of_row)(Row const&, double*), FieldSet reads,
                                   Particles<Dim> const& particles);

 private:
  struct Records;

  std::string_view loops_of(Particles<Dim> const& particles) const;
  FusedSweep const* fused(SweepPlan const& plan, std::string_view kernel, SweepKernels const& kernels) const;
  SweepPlan plan(Particles<Dim> const& particles, Records const& records) const;

  NeighbourList const& neighbours_;
  Domain<Dim> const& domain_;
  int threads_;
  FieldSet reads_;
  bool wants_radial_ = false, wants_separation_ = false, wants_value_ = false, wants_offset_ = false, wants_own_radial_ = false;
  std::vector<RowTerm> terms_;
};

extern template class PairSweep<1>;
extern template class PairSweep<2>;
extern template class PairSweep<3>;

}  // namespace sphverify
