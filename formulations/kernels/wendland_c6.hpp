// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "formulations/kernels/scaled.hpp"

namespace sphverify {

/// Wendland's kernel with 6 continuous derivatives (Wendland 1995, Adv. Comput. Math. 4, 389; Dehnen & Aly
/// 2012, MNRAS 425, 1068, Table 1), support 2h.
///
///   W(r, h) = sigma/h^Dim (1 - q/2)_+^7 (1 + 7q/2 + 19q^2/4 + 21q^3/8)   in 1 dimension, q = r/h, x_+ =
///   max(x, 0)
///             sigma/h^Dim (1 - q/2)_+^8 (1 + 4q + 25q^2/4 + 4q^3)   in 2 and 3
///
/// with sigma = 55/64, 39/(14 pi), 1365/(512 pi) in 1, 2, 3 dimensions. W'/q is a polynomial times a power of
/// 1 - q/2.
template <int Dim>
struct WendlandC6 : Scaled<WendlandC6<Dim>, Dim> {
  static constexpr std::string_view id = "wendland-c6";
  static constexpr std::string_view title = "Wendland C6 of support 2h";
  static constexpr std::string_view source = "Wendland 1995; Dehnen & Aly 2012";
  static constexpr std::string_view equation =
      "W = sigma/h (1 - q/2)_+^7 (1 + 7q/2 + 19q^2/4 + 21q^3/8) in 1D, "
      "sigma/h^D (1 - q/2)_+^8 (1 + 4q + 25q^2/4 + 4q^3) in 2D and 3D, q = r/h, x_+ = max(x, 0)";
  static constexpr double support_ratio = 2.0;  ///< support / smoothing length
  static constexpr double sigma = Dim == 1   ? 55.0 / 64.0
                                  : Dim == 2 ? 39.0 / (14.0 * std::numbers::pi)
                                             : 1365.0 / (512.0 * std::numbers::pi);

  static auto shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      auto const p2 = p * p;
      return p2 * p2 * p2 * p * (1.0 + q * (3.5 + q * (4.75 + 2.625 * q)));
    } else {
      auto const p2 = p * p;
      auto const p4 = p2 * p2;
      return p4 * p4 * (1.0 + q * (4.0 + q * (6.25 + 4.0 * q)));
    }
  }
  static auto slope_shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    if constexpr (Dim == 1) {
      auto const p2 = p * p;
      return p2 * p2 * p2 * (-4.5 - q * (13.5 + 13.125 * q));
    } else {
      auto const p2 = p * p;
      return p2 * p2 * p2 * p * (-5.5 - q * (19.25 + 22.0 * q));
    }
  }
};

}  // namespace sphverify
