#pragma once

#include <span>
#include <utility>

#include "formulations/kernels/all.hpp"
#include "formulations/sweep/fused.hpp"

// The loops over pairs that a scheme has of its own. Included by the files that are compiled once per instruction set, and
// by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

template <class Scheme, std::size_t n, int Dim>
void sum_pass(Row const& row, void const* parameters, double* out) {
  sum_row<PassTerm<Scheme, n, Dim>, Dim>(row, parameters, out);
}

template <class Scheme, int Dim>
void conductance_of_row(Row const& row, double* out) {
  constexpr FieldSet reads = RateTerm<Scheme, Dim>::reads;
  View<Dim, reads, ReadOwn> const i(row.slots, ReadOwn{row.own});
  for (std::size_t k = 0; k < row.count; k += Pack::size) {
    View<Dim, reads, ReadColumns> const j(row.slots, ReadColumns{row.columns + k});
    KernelColumns<Dim> const W(row, k);
    Scheme::conductance(i, j, DeclaredKernel<Scheme::info.kernel, KernelColumns<Dim>>(W)).store(out + k);
  }
}

/// The pairs of a scheme's passes, that of the rate last.
template <class Scheme, int Dim>
constexpr SchemeLoops loops_of() {
  SchemeLoops loops{};
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    ((loops.passes[n] = sum_pass<Scheme, n, Dim>), ...);
  }(std::make_index_sequence<std::tuple_size_v<AllPasses<Scheme>>>());
  if constexpr (Scheme::info.difference_form) loops.conductance = conductance_of_row<Scheme, Dim>;
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

/// For each kernel of ours the loops made for just this scheme; for ours they lie with the kernel (kernels.hpp).
template <class Scheme, int Dim>
std::span<FusedWithKernel const> fused_with_kernels() {
  if constexpr (specialises) {
    static constexpr auto all = []<class... Kernels>(std::tuple<Kernels...> const*) {
      auto const with = []<class Kernel>(Kernel const*) {
        auto const loops = fused_passes<Dim, Kernel, Scheme>();
        std::array<FusedWithKernel, loops.size()> named{};
        for (std::size_t n = 0; n < loops.size(); ++n) named[n] = {Kernel::id, loops[n]};
        return named;
      };
      return joined(with(static_cast<Kernels const*>(nullptr))...);
    }(static_cast<KernelList<Dim> const*>(nullptr));
    return all;
  } else {
    return {};
  }
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
