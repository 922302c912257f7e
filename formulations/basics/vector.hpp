#pragma once

#include <Eigen/Core>

namespace sphverify {

/// A point or direction in Dim = 1, 2 or 3 dimensions.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

}  // namespace sphverify
