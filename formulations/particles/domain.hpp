// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "formulations/basics/vector.hpp"

namespace sphverify {

/// A box [m] between `lower` and `upper` along its own axes, which are those of space unless it is turned
/// about the origin; along a periodic axis its two sides are the same place.
template <int Dim>
struct Domain {
  using Axes = Eigen::Matrix<double, Dim, Dim>;

  Vector<Dim> lower;
  Vector<Dim> upper;
  std::array<bool, Dim> periodic{};
  Axes axes = Axes::Identity();  ///< columns: the box's axes, orthonormal

  Vector<Dim> extent() const { return upper - lower; }
  double volume() const { return extent().prod(); }

  bool is_turned() const { return axes != Axes::Identity(); }
  /// Coordinates along the box's own axes, and back.
  Vector<Dim> to_box(Vector<Dim> const& x) const { return axes.transpose() * x; }
  Vector<Dim> to_space(Vector<Dim> const& along_axes) const { return axes * along_axes; }

  bool is_periodic() const {
    for (bool const axis : periodic) {
      if (axis) return true;
    }
    return false;
  }

  /// The shortest of the periodic images of a separation. Expects components within one period.
  Vector<Dim> nearest_image(Vector<Dim> separation) const {
    for (int k = 0; k < Dim; ++k) {
      if (!periodic[k]) continue;
      double const period = upper[k] - lower[k];
      double const along = axes.col(k).dot(separation);
      if (along > 0.5 * period) separation -= period * axes.col(k);
      if (along < -0.5 * period) separation += period * axes.col(k);
    }
    return separation;
  }
};

}  // namespace sphverify
