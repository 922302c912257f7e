// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/exact/slab_insulated.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "cases/exact/require.hpp"

namespace sphverify::exact {

SlabInsulated::SlabInsulated(double mean, std::vector<Mode> modes, double conductivity, double density)
    : mean_(require_finite("mean", mean)),
      modes_(require_modes(std::move(modes))),
      diffusivity_(require_positive("conductivity", conductivity) / require_positive("density", density)) {}

double SlabInsulated::temperature(double x, double t) const {
  require_not_negative("time", t);
  double sum = mean_;
  for (Mode const& mode : modes_) {
    sum += mode.amplitude * std::cos(mode.wavenumber() * x) * mode.decay(diffusivity_, t);
  }
  return sum;
}

double SlabInsulated::gradient(double x, double t) const {
  require_not_negative("time", t);
  double sum = 0.0;
  for (Mode const& mode : modes_) {
    double const k = mode.wavenumber();
    sum -= mode.amplitude * k * std::sin(k * x) * mode.decay(diffusivity_, t);
  }
  return sum;
}

double SlabInsulated::accuracy() const {
  return 2.0 * std::numeric_limits<double>::epsilon() * std::abs(mean_) + rounding(modes_);
}

}  // namespace sphverify::exact
