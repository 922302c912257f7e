#pragma once

#include <Eigen/LU>
#include <cmath>

#include "formulations/basics/undefined_rate.hpp"
#include "formulations/basics/vector.hpp"

namespace sphverify {

/// The inverse of sum V_j (r_j - r_i) (x) grad W, which makes a gradient exact where a field is linear. Throws TooFewPartners
/// where neighbours do not span space.
template <class Sum>
Sum correction_matrix(Sum const& sum) {
  constexpr double least = 1e-6;  // of the size of its elements to the power of the dimension
  double const size = std::pow(sum.norm(), static_cast<double>(sum.rows()));
  if (!(std::abs(sum.determinant()) > least * size)) throw TooFewPartners("its neighbours do not span space");
  return sum.inverse();
}

}  // namespace sphverify
