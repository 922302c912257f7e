// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "formulations/basics/select.hpp"
#include "formulations/kernels/scaled.hpp"

namespace sphverify {

/// Cubic spline kernel (Campbell 1989, Eq. 24; Monaghan & Lattanzio 1985), support 2h.
///
///   W(r, h) = sigma/h^Dim * { 1 - 3/2 q^2 + 3/4 q^3   for q = r/h < 1
///                             1/4 (2 - q)^3           for 1 <= q < 2,  0 beyond }
///
/// with sigma = 2/3, 10/(7 pi), 1/pi in 1, 2, 3 dimensions.
template <int Dim>
struct CubicSpline : Scaled<CubicSpline<Dim>, Dim> {
  static constexpr std::string_view id = "cubic-spline";
  static constexpr std::string_view title = "Cubic spline of support 2h";
  static constexpr std::string_view source = "Campbell 1989, Eq. 24; Monaghan & Lattanzio 1985";
  static constexpr std::string_view equation =
      "W = sigma/h^D (1 - 3/2 q^2 + 3/4 q^3) for q = r/h < 1, sigma/h^D (2 - q)^3/4 for q < 2";
  static constexpr double support_ratio = 2.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 2.0 / 3.0
                                  : Dim == 2 ? 10.0 / (7.0 * std::numbers::pi)
                                             : std::numbers::inv_pi;

  static auto shape(auto q) {
    using std::max;
    auto const p = max(2.0 - q, decltype(q)(0.0));
    return select(q < 1.0, 1.0 - q * q * (1.5 - 0.75 * q), 0.25 * p * p * p);
  }
  static auto slope_shape(auto q) {
    using std::max;
    auto const p = max(2.0 - q, decltype(q)(0.0));
    return select(q < 1.0, -3.0 + 2.25 * q, -0.75 * p * p  / q);
  }
};

}  // namespace sphverify
