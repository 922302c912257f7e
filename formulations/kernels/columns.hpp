// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace sphverify {

/// A kernel in one dimension over columns of distances, whole packs of them, aligned to 32 bytes: with the common smoothing
/// length, or with one for every pair. What loops over pairs have of a kernel.
struct KernelColumns {
  using AtCommon = void (*)(double const* distance, std::size_t pairs, double h, double* out);
  using AtOwn = void (*)(double const* distance, std::size_t pairs, double const* h, double* out);
  AtCommon radial, value;  ///< W'(r)/r  [m^-(Dim+2)] and W  [m^-Dim]
  AtOwn radial_of, value_of;
};

}  // namespace sphverify
