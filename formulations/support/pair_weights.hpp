#pragma once

#include <vector>

#include "formulations/support/flag_set.hpp"
#include "formulations/support/neighbours.hpp"
#include "formulations/support/smoothing_length.hpp"

namespace sphverify {

/// What a scheme reads of the kernel at a pair.
enum class KernelWeight {
  gradient,  ///< grad_i W_ij, a vector  [m^-(Dim+1)]
  radial     ///< (r_ij . grad_i W_ij) / r_ij^2 = W'(r)/r  [m^-(Dim+2)]
};

using KernelWeightSet = FlagSet<KernelWeight>;

/// Kernel weights of every directed pair of a neighbour list, computed once while the particles stand still.
/// Only the kinds that were asked for are stored.
template <int Dim>
struct PairWeights {
  VectorField<Dim> gradient;
  std::vector<double> radial;

  std::size_t bytes() const;
};

template <int Dim>
PairWeights<Dim> evaluate_kernel(NeighbourList const& neighbours, VectorField<Dim> const& positions,
                                 Domain<Dim> const& domain, SmoothingLength const& h, KernelWeightSet wanted);

}  // namespace sphverify
