#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "formulations/basics/select.hpp"

namespace sphverify {

/// Cubic spline kernel (Campbell 1989, Eq. 24; Monaghan & Lattanzio 1985), support 2h.
///
///   W(r, h) = sigma/h^Dim * { 1 - 3/2 q^2 + 3/4 q^3   for q = r/h < 1
///                             1/4 (2 - q)^3           for 1 <= q < 2,  0 beyond }
///
/// with sigma = 2/3, 10/(7 pi), 1/pi in 1, 2, 3 dimensions. Distances in m, W in m^-Dim.
template <int Dim>
struct CubicSpline {
  static_assert(Dim >= 1 && Dim <= 3);
  static constexpr std::string_view id = "cubic-spline";
  static constexpr double support_ratio = 2.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 2.0 / 3.0
                                  : Dim == 2 ? 10.0 / (7.0 * std::numbers::pi)
                                             : std::numbers::inv_pi;

  static double value(double r, double h) { return normalisation(h) * shape(r / h); }

  /// (dW/dr)/r, finite at r = 0; grad_i W_ij = radial(r_ij, h) (r_i - r_j).  [m^-(Dim+2)]
  static double radial(double r, double h) { return slope_normalisation(h) * slope_shape(r / h); }

  /// What the two above are made of, for one number or for several at once: W = normalisation(h) shape(q) and
  /// W'/r = slope_normalisation(h) slope_shape(q).
  static auto shape(auto q) {
    using std::max;
    auto const p = max(2.0 - q, decltype(q)(0.0));
    return select(q < 1.0, 1.0 - q * q * (1.5 - 0.75 * q), 0.25 * p * p * p);
  }
  static auto slope_shape(auto q) { return slope_shape(q, 1.0 / q); }
  /// @param per_q 1/q, where it is known
  static auto slope_shape(auto q, auto per_q) {
    using std::max;
    auto const p = max(2.0 - q, decltype(q)(0.0));
    return select(q < 1.0, -3.0 + 2.25 * q, -0.75 * p * p * per_q);
  }
  static auto normalisation(auto h) { return sigma / power(h, Dim); }
  static auto slope_normalisation(auto h) { return sigma / power(h, Dim + 2); }

  /// Integral of W over a plane at distance d from its centre, the `exact` face weight.  [1/m]
  /// Closed form derived in docs/theory/face-weights.md.
  static double plane_integral(double d, double h);

  /// Gamma(d): the part of the kernel on the inner side of a plane at distance d >= 0, between 1/2 and 1.
  /// Closed form derived in docs/theory/face-weights.md; its derivative by d is plane_integral.
  static double inner_fraction(double d, double h);

 private:
  static constexpr auto power(auto x, int n) {
    auto result = x;
    for (int k = 1; k < n; ++k) result = x * result;
    return result;
  }
};

}  // namespace sphverify
