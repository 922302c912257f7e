// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "formulations/basics/undefined_rate.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// The inverse of sum V_j (r_j - r_i) (x) grad W, near 1 where neighbours are all around, which makes a gradient exact where a
/// field is linear. Throws TooFewPartners where they are so few, so far, or so much in one direction that it is near 0.
template <class Sum>
Sum correction_matrix(Sum const& sum) {
  constexpr double least = 5e-3;  // along each axis
  if (!(std::abs(sum.determinant()) > std::pow(least, static_cast<double>(sum.rows())))) throw TooFewPartners("its neighbours do not span space: take a larger h/dx");
  return sum.inverse();
}

}  // namespace sphverify
