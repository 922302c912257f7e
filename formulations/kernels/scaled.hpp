// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// What every kernel has that gives its shape:
///
///   W(r, h) = sigma/h^Dim shape(q),  (dW/dr)/r = sigma/h^(Dim+2) slope_shape(q),  q = r/h.
///
/// `shape` and `slope_shape` are written once for one number, for several at once
/// (formulations/simd/pack.hpp) and for polynomials (formulations/kernels/on_piece.hpp): with +, -, *, select
/// and max, from which it also follows that they have a value for every q, zero beyond the support. Between
/// whole q they are polynomials. Distances in m, W in m^-Dim.
template <class Kernel, int Dim>
struct Scaled {
  static_assert(Dim >= 1 && Dim <= 3);

  static double value(double r, double h) { return normalisation(h) * Kernel::shape(r / h); }

  /// (dW/dr)/r, finite at r = 0; grad_i W_ij = radial(r_ij, h) (r_i - r_j).  [m^-(Dim+2)]
  static double radial(double r, double h) { return slope_normalisation(h) * Kernel::slope_shape(r / h); }

  static auto normalisation(auto h) { return Kernel::sigma / power(h, Dim); }
  static auto slope_normalisation(auto h) { return Kernel::sigma / power(h, Dim + 2); }

 private:
  static constexpr auto power(auto x, int n) {
    auto result = x;
    for (int k = 1; k < n; ++k) result = x * result;
    return result;
  }
};

}  // namespace sphverify
