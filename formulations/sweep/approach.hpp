// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace sphverify {

/// How fast a pair closes in, relative to its distance: the inverse of the time in which it would meet. [1/s]
/// In one dimension particles must not meet. Beyond it they pass, and what they feel varies over h rather
/// than over a distance that may be next to nothing: there a tenth of h counts as met, as it does in the
/// viscosity. Otherwise two that run into each other head-on, as mirror images do, would never be done.
/// @param closing -(v_i - v_j).r_ij  [m^2/s]
template <int Dim, class Number>
Number rate_of_approach(Number closing, Number squared_distance, Number h) {
  if constexpr (Dim == 1) {
    return closing / squared_distance;
  } else {
    return closing / (squared_distance + 0.01 * h * h);
  }
}

}  // namespace sphverify
