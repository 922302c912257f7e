// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "formulations/kernels/scaled.hpp"

namespace sphverify {

/// Wendland's kernel with 2 continuous derivatives (Wendland 1995, Adv. Comput. Math. 4, 389; Dehnen & Aly
/// 2012, MNRAS 425, 1068, Table 1), support 2h.
///
///   W(r, h) = sigma/h^Dim (1 - q/2)_+^3 (1 + 3q/2)   in 1 dimension, q = r/h, x_+ = max(x, 0)
///             sigma/h^Dim (1 - q/2)_+^4 (1 + 2q)   in 2 and 3
///
/// with sigma = 5/8, 7/(4 pi), 21/(16 pi) in 1, 2, 3 dimensions. W'/q is a polynomial times a power of 1 -
/// q/2.
template <int Dim>
struct WendlandC2 : Scaled<WendlandC2<Dim>, Dim> {
  static constexpr std::string_view id = "wendland-c2";
  static constexpr std::string_view title = "Wendland C2 of support 2h";
  static constexpr std::string_view source = "Wendland 1995; Dehnen & Aly 2012";
  static constexpr std::string_view equation =
      "W = sigma/h (1 - q/2)_+^3 (1 + 3q/2) in 1D, "
      "sigma/h^D (1 - q/2)_+^4 (1 + 2q) in 2D and 3D, q = r/h, x_+ = max(x, 0)";
  static constexpr double support_ratio = 2.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 5.0 / 8.0
                                  : Dim == 2 ? 7.0 / (4.0 * std::numbers::pi)
                                             : 21.0 / (16.0 * std::numbers::pi);

  static auto shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      return p * p * p * (1.0 + 1.5 * q);
    } else {
      auto const p2 = p * p;
      return p2 * p2 * (1.0 + 2.0 * q);
    }
  }
  static auto slope_shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      return -3.0 * (p * p);
    } else {
      return -5.0 * (p * p * p);
    }
  }
};

}  // namespace sphverify
