// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/half_space_step.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

HalfSpaceStep::HalfSpaceStep(double wall, double initial, double conductivity, double density)
    : wall_(require_finite("wall", wall)),
      initial_(require_finite("initial", initial)),
      diffusivity_(require_positive("conductivity", conductivity) / require_positive("density", density)) {}

double HalfSpaceStep::temperature(double x, double t) const {
  require_not_negative("time", t);
  if (t == 0.0) return x > 0.0 ? initial_ : wall_;
  return initial_ + (wall_ - initial_) * std::erfc(x / (2.0 * std::sqrt(diffusivity_ * t)));
}

double HalfSpaceStep::gradient(double x, double t) const {
  require_not_negative("time", t);
  double const jump = wall_ - initial_;
  if (t == 0.0) {
    if (x > 0.0 || jump == 0.0) return 0.0;
    return std::copysign(std::numeric_limits<double>::infinity(), -jump);
  }
  double const length = 2.0 * std::sqrt(diffusivity_ * t);
  double const z = x / length;
  return -2.0 * std::numbers::inv_sqrtpi * jump / length * std::exp(-z * z);
}

double HalfSpaceStep::accuracy() const {
  return 8.0 * std::numeric_limits<double>::epsilon() * (std::abs(wall_) + std::abs(initial_));
}

}  // namespace sphverify::exact
