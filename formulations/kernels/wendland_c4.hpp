// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "formulations/kernels/scaled.hpp"

namespace sphverify {

/// Wendland's kernel with 4 continuous derivatives (Wendland 1995, Adv. Comput. Math. 4, 389; Dehnen & Aly
/// 2012, MNRAS 425, 1068, Table 1), support 2h.
///
///   W(r, h) = sigma/h^Dim (1 - q/2)_+^5 (1 + 5q/2 + 2q^2)   in 1 dimension, q = r/h, x_+ = max(x, 0)
///             sigma/h^Dim (1 - q/2)_+^6 (1 + 3q + 35q^2/12)   in 2 and 3
///
/// with sigma = 3/4, 9/(4 pi), 495/(256 pi) in 1, 2, 3 dimensions. W'/q is a polynomial times a power of 1 -
/// q/2.
template <int Dim>
struct WendlandC4 : Scaled<WendlandC4<Dim>, Dim> {
  static constexpr std::string_view id = "wendland-c4";
  static constexpr std::string_view title = "Wendland C4 of support 2h";
  static constexpr std::string_view source = "Wendland 1995; Dehnen & Aly 2012";
  static constexpr std::string_view equation =
      "W = sigma/h (1 - q/2)_+^5 (1 + 5q/2 + 2q^2) in 1D, "
      "sigma/h^D (1 - q/2)_+^6 (1 + 3q + 35q^2/12) in 2D and 3D, q = r/h, x_+ = max(x, 0)";
  static constexpr double support_ratio = 2.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 3.0 / 4.0
                                  : Dim == 2 ? 9.0 / (4.0 * std::numbers::pi)
                                             : 495.0 / (256.0 * std::numbers::pi);

  static auto shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      auto const p2 = p * p;
      return p2 * p2 * p * (1.0 + q * (2.5 + 2.0 * q));
    } else {
      auto const p2 = p * p;
      return p2 * p2 * p2 * (1.0 + q * (3.0 + 35.0 / 12.0 * q));
    }
  }
  static auto slope_shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      auto const p2 = p * p;
      return p2 * p2 * (-3.5 - 7.0 * q);
    } else {
      auto const p2 = p * p;
      return p2 * p2 * p * (-14.0 / 3.0 - 35.0 / 3.0 * q);
    }
  }
};

}  // namespace sphverify
