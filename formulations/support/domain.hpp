#pragma once

#include <array>

#include "formulations/support/vector.hpp"

namespace sphverify {

/// An axis-parallel box [m]; along a periodic axis its two sides are the same place.
template <int Dim>
struct Domain {
  Vector<Dim> lower;
  Vector<Dim> upper;
  std::array<bool, Dim> periodic{};

  Vector<Dim> extent() const { return upper - lower; }

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
      if (separation[k] > 0.5 * period) separation[k] -= period;
      if (separation[k] < -0.5 * period) separation[k] += period;
    }
    return separation;
  }
};

}  // namespace sphverify
