// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/slab_dirichlet.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

SlabDirichlet::SlabDirichlet(double left, double right, std::vector<Mode> modes, double conductivity,
                             double density)
    : left_(require_finite("left", left)),
      right_(require_finite("right", right)),
      modes_(require_modes(std::move(modes))),
      diffusivity_(require_positive("conductivity", conductivity) / require_positive("density", density)) {}

double SlabDirichlet::temperature(double x, double t) const {
  require_not_negative("time", t);
  double sum = left_ + (right_ - left_) * x;
  for (Mode const& mode : modes_) {
    sum += mode.amplitude * std::sin(mode.wavenumber() * x) * mode.decay(diffusivity_, t);
  }
  return sum;
}

double SlabDirichlet::gradient(double x, double t) const {
  require_not_negative("time", t);
  double sum = right_ - left_;
  for (Mode const& mode : modes_) {
    double const k = mode.wavenumber();
    sum += mode.amplitude * k * std::cos(k * x) * mode.decay(diffusivity_, t);
  }
  return sum;
}

double SlabDirichlet::accuracy() const {
  return 2.0 * std::numeric_limits<double>::epsilon() * (std::abs(left_) + std::abs(right_)) +
         rounding(modes_);
}

}  // namespace sphverify::exact
