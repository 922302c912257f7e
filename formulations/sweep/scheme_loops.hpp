// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "formulations/sweep/row_loops.hpp"

// The loops over pairs that a scheme has of its own. Included by the files that are compiled once per instruction set, and
// by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

template <class Scheme, int Dim>
void conductance_of_batch(Batch const& batch, double* out) {
  constexpr FieldSet reads = RateTerm<Scheme, Dim>::reads;
  for (std::size_t row = 0; row < batch.rows; ++row) {
    View<Dim, reads, ReadOwn> const i(batch.slots, ReadOwn{batch.records + (batch.begin + row) * batch.stride});
    for (std::size_t k = batch.first[row]; k < batch.first[row + 1]; k += Pack::size) {
      View<Dim, reads, ReadRecords> const j(batch.slots, ReadRecords{FourRecords(batch, k)});
      KernelOfPairs<Dim> const W(batch, k);
      Scheme::conductance(i, j, DeclaredKernel<Scheme::info.kernel, KernelOfPairs<Dim>>(W)).store(out + k);
    }
  }
}

/// The pairs of a scheme's passes, that of the rate last.
template <class Scheme, int Dim>
constexpr SchemeLoops loops_of() {
  SchemeLoops loops{};
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    ((loops.passes[n] = loops_of_term<Dim, PassTerm<Scheme, n, Dim>>()), ...);
  }(std::make_index_sequence<std::tuple_size_v<AllPasses<Scheme>>>());
  if constexpr (Scheme::info.difference_form) loops.conductance = conductance_of_batch<Scheme, Dim>;
  return loops;
}

/// Other files know of them by this name alone.
template <class Scheme, int Dim>
SchemeLoops const& scheme_loops() {
  static_assert(IsScheme<Scheme>, "a scheme has a constexpr `info`, in `passes` the code of the first passes that it names, and "
                                  "reads of pass_... only what these write, and the fields from which walls take what they do "
                                  "not prescribe (formulations/scheme.hpp)");
  static constexpr SchemeLoops loops = loops_of<Scheme, Dim>();
  return loops;
}

/// Compiles the loops of all schemes of a list.
template <class List>
struct LoopsOfAll;
template <class... Schemes>
struct LoopsOfAll<std::tuple<Schemes...>> {
  using Loops = SchemeLoops const& (*)();
  static Loops const loops[];
};
template <class... Schemes>
typename LoopsOfAll<std::tuple<Schemes...>>::Loops const LoopsOfAll<std::tuple<Schemes...>>::loops[] = {
    scheme_loops<Schemes, 1>..., scheme_loops<Schemes, 2>..., scheme_loops<Schemes, 3>...};

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
