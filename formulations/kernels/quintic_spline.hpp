// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "formulations/basics/select.hpp"
#include "formulations/kernels/scaled.hpp"

namespace sphverify {

/// Quintic spline kernel M6 (Morris, Fox & Zhu 1997, J. Comput. Phys. 136, 214), support 3h.
///
///   W(r, h) = sigma/h^Dim [(3 - q)_+^5 - 6 (2 - q)_+^5 + 15 (1 - q)_+^5],  q = r/h,  x_+ = max(x, 0)
///
/// with sigma = 1/120, 7/(478 pi), 1/(120 pi) in 1, 2, 3 dimensions. For q < 1 it is
/// 66 - 60 q^2 + 30 q^4 - 10 q^5.
template <int Dim>
struct QuinticSpline : Scaled<QuinticSpline<Dim>, Dim> {
  static constexpr std::string_view id = "quintic-spline";
  static constexpr std::string_view title = "Quintic spline of support 3h";
  static constexpr std::string_view source = "Morris, Fox & Zhu 1997";
  static constexpr std::string_view equation =
      "W = sigma/h^D [(3 - q)_+^5 - 6 (2 - q)_+^5 + 15 (1 - q)_+^5], q = r/h, x_+ = max(x, 0)";
  static constexpr double support_ratio = 3.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 1.0 / 120.0
                                  : Dim == 2 ? 7.0 / (478.0 * std::numbers::pi)
                                             : 1.0 / (120.0 * std::numbers::pi);

  static auto shape(auto q) {
    using std::max;
    auto const a = max(3.0 - q, decltype(q)(0.0));
    auto const b = max(2.0 - q, decltype(q)(0.0));
    auto const q2 = q * q;
    auto const a2 = a * a;
    auto const b2 = b * b;
    return select(q < 1.0, 66.0 - q2 * (60.0 - q2 * (30.0 - 10.0 * q)), a2 * a2 * a - 6.0 * (b2 * b2 * b));
  }
  static auto slope_shape(auto q) {
    using std::max;
    auto const a = max(3.0 - q, decltype(q)(0.0));
    auto const b = max(2.0 - q, decltype(q)(0.0));
    auto const a2 = a * a;
    auto const b2 = b * b;
    return select(q < 1.0, -120.0 + q * q * (120.0 - 50.0 * q), (30.0 * (b2 * b2) - 5.0 * (a2 * a2))  / q);
  }
};

}  // namespace sphverify
