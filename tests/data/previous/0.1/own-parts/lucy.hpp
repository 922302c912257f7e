// SPDX-License-Identifier: 0BSD
// A kernel that sphverify does not have.
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "formulations/kernels/scaled.hpp"

/// Lucy's kernel (Lucy 1977, Astron. J. 82, 1013), here with support 2h.
///
///   W(r, h) = sigma/h^Dim (1 + 3q/2) (1 - q/2)_+^3,  q = r/h,  sigma = 5/8, 5/(4 pi), 105/(128 pi) in 1, 2, 3 dimensions
template <int Dim>
struct Lucy : sphverify::Scaled<Lucy<Dim>, Dim> {
  static constexpr std::string_view id = "lucy";
  static constexpr std::string_view title = "Lucy's kernel of support 2h";
  static constexpr std::string_view source = "Lucy 1977";
  static constexpr std::string_view equation = "W = sigma/h^D (1 + 3q/2) (1 - q/2)_+^3, q = r/h, x_+ = max(x, 0)";
  static constexpr double support_ratio = 2.0;
  static constexpr double sigma = Dim == 1   ? 5.0 / 8.0
                                  : Dim == 2 ? 5.0 / (4.0 * std::numbers::pi)
                                             : 105.0 / (128.0 * std::numbers::pi);

  static auto shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    return p * p * p * (1.0 + 1.5 * q);
  }
  /// W'/q: here -3 (1 - q/2)_+^2
  static auto slope_shape(auto q) {
    using std::max;
    auto const p = max(1.0 - 0.5 * q, decltype(q)(0.0));
    return -3.0 * p * p;
  }
};
