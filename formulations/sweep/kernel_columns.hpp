// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formulations/kernels/all.hpp"
#include "formulations/simd/pack.hpp"
#include "formulations/sweep/sweep.hpp"

// A kernel over columns of distances: all of it that a sweep needs, so that the loops of schemes are compiled once for all
// kernels. Included by the files that are compiled once per instruction set, and by nothing else.
namespace sphverify::SPHVERIFY_INSTRUCTION_SET {

/// out = scale/h^power shape(r/h), pack by pack.
/// @tparam power Dim for W, Dim + 2 for W'(r)/r
template <class Kernel, int power, class Shape>
void kernel_column(double const* distance, std::size_t pairs, double h, double* out, Shape const& shape) {
  Pack const per_h = 1.0 / h;
  Pack const scale = Pack(Kernel::sigma) * integer_power<power>(per_h);
  for (std::size_t k = 0; k < pairs; k += Pack::size) (scale * shape(Pack::load(distance + k) * per_h)).store(out + k);
}
template <class Kernel, int power, class Shape>
void kernel_column(double const* distance, std::size_t pairs, double const* h, double* out, Shape const& shape) {
  for (std::size_t k = 0; k < pairs; k += Pack::size) {
    Pack const per_h = Pack(1.0) / Pack::load(h + k);
    Pack const scale = Pack(Kernel::sigma) * integer_power<power>(per_h);
    (scale * shape(Pack::load(distance + k) * per_h)).store(out + k);
  }
}

/// @tparam Length double, or double const* to one for every pair
template <class Kernel, int Dim, class Length>
void radial_column(double const* distance, std::size_t pairs, Length h, double* out) {
  kernel_column<Kernel, Dim + 2>(distance, pairs, h, out, [](Pack q) SPHVERIFY_FORCE_INLINE { return Kernel::slope_shape(q); });
}
template <class Kernel, int Dim, class Length>
void value_column(double const* distance, std::size_t pairs, Length h, double* out) {
  kernel_column<Kernel, Dim>(distance, pairs, h, out, [](Pack q) SPHVERIFY_FORCE_INLINE { return Kernel::shape(q); });
}

/// Other files know of them by this name alone.
template <class Kernel, int Dim>
KernelColumns kernel_columns() {
  return {.radial = radial_column<Kernel, Dim, double>,
          .value = value_column<Kernel, Dim, double>,
          .radial_of = radial_column<Kernel, Dim, double const*>,
          .value_of = value_column<Kernel, Dim, double const*>};
}

/// Compiles those of all kernels of a list.
template <class List>
struct ColumnsOfAll;
template <template <int> class... Kernels>
struct ColumnsOfAll<KernelPack<Kernels...>> {
  using Columns = KernelColumns (*)();
  static Columns const columns[];
};
template <template <int> class... Kernels>
typename ColumnsOfAll<KernelPack<Kernels...>>::Columns const ColumnsOfAll<KernelPack<Kernels...>>::columns[] = {
    kernel_columns<Kernels<1>, 1>..., kernel_columns<Kernels<2>, 2>..., kernel_columns<Kernels<3>, 3>...};

}  // namespace sphverify::SPHVERIFY_INSTRUCTION_SET
