// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "formulations/basics/tensor_index.hpp"

namespace sphverify {

/// A point or direction in Dim = 1, 2 or 3 dimensions.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

/// A symmetric tensor.
template <int Dim>
using Tensor = Eigen::Matrix<double, Dim, Dim>;

/// a b^T of two vectors along each other, which is symmetric.
template <int Dim>
Tensor<Dim> outer(Vector<Dim> const& a, Vector<Dim> const& b) {
  return a * b.transpose();
}

}  // namespace sphverify
